# SPDX-License-Identifier: Apache-2.0
# The packages of Debian 12 and 13, which have the same names, and how the scripts install them. To be
# sourced.

LIBRARY_PACKAGES=(g++ cmake ninja-build libeigen3-dev libgeographiclib-dev libgtest-dev pkg-config)  # tests included
BUILD_PACKAGES=(
  g++ make cmake ninja-build pkg-config python3 python3-venv
  libeigen3-dev libgeographiclib-dev
  nlohmann-json3-dev libcli11-dev libboost-dev libfmt-dev libqrencode-dev libyaml-cpp-dev zlib1g-dev libgdal-dev
  libopencv-core-dev libopencv-imgproc-dev libopencv-imgcodecs-dev libopencv-calib3d-dev libopencv-dnn-dev
  libgstreamer1.0-dev libgstreamer-plugins-base1.0-dev libgstrtspserver-1.0-dev
)
RUN_PACKAGES=(
  gstreamer1.0-plugins-base gstreamer1.0-plugins-good gstreamer1.0-plugins-bad gstreamer1.0-plugins-ugly
  gstreamer1.0-libav
)
TEST_PACKAGES=(git ccache chromium libgtest-dev libbenchmark-dev gdal-bin)
LINT_PACKAGES=(clang clang-format clang-tidy libclang-rt-dev)
OPENVINO_VERSION=2026.4.1  # on PyPI

say() { printf '\033[1m== %s\033[0m\n' "$*" >&2; }

# install_packages NAME…: installs missing packages, as root or with sudo. If none is missing, it takes no time and
# no network.
install_packages() {
  local missing=() package
  for package in "$@"; do
    dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "Needed, as root: apt-get install ${missing[*]}" >&2; return 1; }
    as_root=(sudo)
  fi
  say "Installing ${#missing[@]} packages"
  mkdir -p "$ROOT/build/apt-tmp"  # some packages' scripts fail if /tmp is a small RAM disk
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -q >/dev/null
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive TMPDIR="$ROOT/build/apt-tmp" \
    apt-get install -y -q --no-install-recommends "${missing[@]}" >"$ROOT/build/apt.log" 2>&1 ||
    { tail -n 20 "$ROOT/build/apt.log" >&2; echo "apt-get failed; all of it is in build/apt.log" >&2; return 1; }
}
