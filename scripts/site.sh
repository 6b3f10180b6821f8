#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# scripts/site.sh: the pages as a site with a search, and the interfaces in C++, C and Python, in out/site/VERSION: a folder of files that
# fetches nothing from elsewhere. Any server of files shows it (python3 -m http.server -d out/site); without one it can be read, but not
# searched. Other versions' folders beside it stay, and are offered by a menu. It ends with checks: every link leads somewhere, nothing comes from elsewhere, the search finds what is there.
set -euo pipefail
ROOT=$(cd "$(dirname "$0")/.." && pwd)
cd "$ROOT"
mkdir -p build out/site
source scripts/packages.sh
install_packages "${SITE_PACKAGES[@]}"
tools=build/site-tools
install_from_pypi "$tools" packaging/site/requirements.txt --only-binary :all: --no-deps

version=$(sed -n 's/^project(geoloc VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
export GEOLOC_SITE_SOURCE=$ROOT/build/site-source GEOLOC_SITE=$ROOT/out/site/$version GEOLOC_PYTHON=$ROOT/python
export GEOLOC_SITE_FOOTER="geoloc $version, Apache-2.0"
rm -rf "$GEOLOC_SITE_SOURCE" "$GEOLOC_SITE"
say "Gathering the pages"
python3 packaging/site/gather.py "$GEOLOC_SITE_SOURCE"
say "The interface in C++ and C"
mkdir -p "$GEOLOC_SITE_SOURCE/api"
headers=$(sed -n 's/^set(_public_modules \(.*\))$/\1/p' cmake/GeolocInstall.cmake | sed 's,\([a-z]*\),include/geoloc/\1,g')
(cat packaging/site/Doxyfile && echo "PROJECT_NUMBER = $version
INPUT = include/geoloc/geoloc.hpp include/geoloc/geoloc.h $headers
OUTPUT_DIRECTORY = $GEOLOC_SITE_SOURCE/api
HTML_OUTPUT = cpp") | doxygen - >build/doxygen.log 2>&1 || { tail -n 20 build/doxygen.log >&2; exit 1; }
say "The site"
NO_MKDOCS_2_WARNING=1 "$tools/bin/mkdocs" --quiet build --config-file packaging/site/mkdocs.yml
python3 - out/site "$version" <<'PYTHON'
import json, pathlib, sys
site, newest = pathlib.Path(sys.argv[1]), sys.argv[2]
versions = sorted((folder.name for folder in site.iterdir() if folder.is_dir()), key=lambda name: [int(part) for part in name.split(".")], reverse=True)
(site / "versions.json").write_text(json.dumps([{"version": name, "title": name, "aliases": []} for name in versions]))
(site / "index.html").write_text(f'<!doctype html><meta http-equiv="refresh" content="0; url={versions[0]}/index.html"><a href="{versions[0]}/index.html">geoloc</a>\n')
PYTHON
python3 packaging/site/check.py "$GEOLOC_SITE"
say "out/site/index.html is the site: python3 -m http.server -d out/site"
