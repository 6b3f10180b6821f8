# SPDX-License-Identifier: Apache-2.0
# The packages of Debian 12 and 13, which have the same names, how the scripts install them, and how they configure a build. To be
# sourced.

LIBRARY_PACKAGES=(g++ cmake ninja-build libeigen3-dev libgeographiclib-dev libgtest-dev pkg-config)  # tests included
BUILD_PACKAGES=(
  g++ make cmake ninja-build ccache pkg-config python3 python3-venv
  libeigen3-dev libgeographiclib-dev
  nlohmann-json3-dev libcli11-dev libboost-dev libfmt-dev libmosquitto-dev libpq-dev libqrencode-dev libssl-dev libyaml-cpp-dev zlib1g-dev
  libopencv-core-dev libopencv-imgproc-dev libopencv-imgcodecs-dev libopencv-calib3d-dev libopencv-dnn-dev
  libgstreamer1.0-dev libgstreamer-plugins-base1.0-dev libgstrtspserver-1.0-dev
)
GDAL_PACKAGES=(libgdal-dev)  # for --ground FILE and geoloc_import; the demo does without its 68 packages
RUN_PACKAGES=(
  gstreamer1.0-plugins-base gstreamer1.0-plugins-good gstreamer1.0-plugins-bad gstreamer1.0-plugins-ugly
  gstreamer1.0-libav
)
FLEET_SERVERS=(mosquitto postgresql-postgis)  # a broker and a database, for the fleet demo and the tests
TEST_PACKAGES=("${FLEET_SERVERS[@]}" git chromium dpkg-dev file python3-dev libgtest-dev libbenchmark-dev gdal-bin libimage-exiftool-perl openssl)
SITE_PACKAGES=(git python3 python3-venv doxygen)
LINT_PACKAGES=(clang clang-format clang-tidy libclang-rt-dev)
OPENVINO_VERSION=2026.4.1  # on PyPI

say() { printf '\033[1m== %s\033[0m\n' "$*" >&2; }

# install_packages NAME…: installs missing packages, as root or with sudo, and says how large they are, and how far it is. If none is
# missing, it takes no time and no network.
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
  say "Reading the lists of packages"
  "${as_root[@]}" apt-get update -q >/dev/null
  local install=(install -y -q --no-install-recommends "${missing[@]}") size count
  # Nothing is installed where the answer is no, but all is said.
  size=$(LC_ALL=C "${as_root[@]}" apt-get "${install[@]/-y/--assume-no}" 2>/dev/null | tr '\n' ' ') || true
  count=$(sed -n 's/.* \([0-9]*\) newly installed.*/\1/p' <<<"$size")
  size=$(sed -n 's/.*Need to get \(.*\) of archives.* \([0-9.,]* [kMG]B\) of additional disk.*/\1 of download, \2 on disk/p' <<<"$size")
  say "Installing ${#missing[@]} packages${count:+, $count with what they need}${size:+: $size}"
  mkdir -p "$ROOT/build/apt-tmp"  # some packages' scripts fail if /tmp is a small RAM disk
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive TMPDIR="$ROOT/build/apt-tmp" LC_ALL=C \
    apt-get "${install[@]}" >"$ROOT/build/apt.log" 2>&1 &
  watch_installation $! "${count:-0}"
  wait $! ||
    { tail -n 20 "$ROOT/build/apt.log" >&2; echo "apt-get failed; all of it is in build/apt.log" >&2; return 1; }
}

# add_arm64: makes packages for 64-bit Arm installable beside this processor's, as root.
add_arm64() {
  ! dpkg --print-foreign-architectures | grep -qx arm64 || return 0
  dpkg --add-architecture arm64
  apt-get update -q >/dev/null
}

# count_in_log START: the lines of apt's log that start so.
count_in_log() { grep -c "^$1" "$ROOT/build/apt.log" || true; }  # grep fails where it counts none

# watch_installation PROCESS COUNT: shows how many packages are there, until the process ends.
watch_installation() {
  local every_s=10 end=$'\n' seconds=0
  [ ! -t 2 ] || { every_s=1 end=$'\r'; }
  while sleep 1 && kill -0 "$1" 2>/dev/null; do
    seconds=$((seconds + 1))
    [ $((seconds % every_s)) -eq 0 ] || continue
    printf 'fetched %s, unpacked %s, set up %s of %s packages%s' \
      "$(count_in_log Get:)" "$(count_in_log 'Unpacking ')" "$(count_in_log 'Setting up ')" "$2" "$end" >&2
  done
  [ "$end" = $'\n' ] || echo >&2
}

# install_from_pypi VENV REQUIREMENTS [PIP-OPTION…]: an environment of Python with what that file lists, made anew where it has changed.
install_from_pypi() {
  local venv=$1 wanted=$2 log=$1.log
  ! cmp -s "$wanted" "$venv/installed.txt" || return 0
  say "Installing $wanted into $venv"
  rm -rf "$venv"
  mkdir -p "$(dirname "$venv")"
  python3 -m venv "$venv"
  "$venv/bin/pip" install --quiet --disable-pip-version-check "${@:3}" -r "$wanted" >"$log" 2>&1 ||
    { tail -n 20 "$log" >&2; echo "pip could not install $wanted, which needs PyPI; all of it is in $log" >&2; return 1; }
  cp "$wanted" "$venv/installed.txt"
}

PROGRAMS_ONLY=(-DGEOLOC_BUILD_TESTS=OFF -DGEOLOC_BUILD_EXAMPLES=OFF -DGEOLOC_BUILD_BENCH=OFF)

# configure PRESET [CMAKE-OPTION…]: the same compiler options for all scripts, so that none compiles again what another has.
configure() {
  export CCACHE_BASEDIR=$ROOT CCACHE_NOHASHDIR=true  # shares compiled files between clones
  say "Configuring ($1)"
  # A newer compiler may have new warnings, which must not stop a user: only .ci/run makes them errors.
  cmake --preset "$1" -DGEOLOC_WARNINGS_AS_ERRORS=OFF -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=16 "${@:2}" \
    >build/configure.log 2>&1 || { cat build/configure.log; return 1; }
}
