#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""scripts/settings_tables.py [GEOLOC_APP]: writes the tables of docs/settings.md anew from geoloc_app --print-settings.

A line `<!-- settings: PREFIX… -->` stands before each table of the page. A setting goes to the table that names the
longest prefix of its path; the prose around the tables stays.
"""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "settings.md"
TABLE = re.compile(r"^<!-- settings: (.*) -->\n((?:\|.*\n)*)", re.MULTILINE)


def is_below(path, prefix):
    return path == prefix or path.startswith((prefix + ".", prefix + "["))


def with_tables(page, printed):
    """The page with its tables filled from what --print-settings printed."""
    heading, ruler, *rows = printed.splitlines(keepends=True)
    prefixes = [prefix for marker in TABLE.finditer(page) for prefix in marker[1].split()]
    rows_of = {prefix: [] for prefix in prefixes}
    for row in rows:
        path = row.split("`")[1]
        homes = [prefix for prefix in prefixes if is_below(path, prefix)]
        if not homes:
            raise SystemExit(f"no table of {PAGE.name} takes {path}: name a prefix of it in a line <!-- settings: … -->")
        rows_of[max(homes, key=len)].append(row)

    def table(marker):
        filled = "".join(row for prefix in marker[1].split() for row in rows_of[prefix])
        return f"<!-- settings: {marker[1]} -->\n{heading}{ruler}{filled}"

    return TABLE.sub(table, page)


if __name__ == "__main__":
    program = sys.argv[1] if len(sys.argv) > 1 else ROOT / "build" / "release" / "bin" / "geoloc_app"
    output = subprocess.run([program, "--print-settings"], check=True, capture_output=True, text=True).stdout
    PAGE.write_text(with_tables(PAGE.read_text(), output))
