# SPDX-License-Identifier: Apache-2.0
import json
import os
import pathlib
import sys
import unittest

from support import AppTest, run

SOURCE = pathlib.Path(os.environ["GEOLOC_SOURCE_DIR"])
sys.path.insert(0, str(SOURCE / "scripts"))
from settings_tables import PAGE, with_tables  # noqa: E402


def leaves(settings, path=""):
    """Every setting as (dotted path, value)."""
    for key, value in settings.items():
        if isinstance(value, dict) and value:
            yield from leaves(value, f"{path}{key}.")
        else:
            yield f"{path}{key}", value


class SettingsReference(AppTest):
    """docs/settings.md is what the program says of itself."""

    def setUp(self):
        super().setUp()
        printed = run("geoloc_app", "--print-settings")
        self.assertEqual(printed.status, 0, printed.err)
        self.printed = printed.out

    def test_the_tables_are_what_the_program_prints(self):
        page = PAGE.read_text()
        self.assertEqual(page, with_tables(page, self.printed), "run scripts/settings_tables.py")

    def test_every_setting_that_is_loaded_is_printed_with_its_default(self):
        config = run("geoloc_app", "--print-config")
        self.assertEqual(config.status, 0, config.err)
        rows = [row.split(" | ") for row in self.printed.splitlines()[2:]]
        printed = {path.strip("| `"): json.loads(default.strip("`")) for path, default, *_ in rows if "[]." not in path}
        self.assertEqual(printed, dict(leaves(json.loads(config.out))))

    def test_every_setting_has_a_meaning(self):
        for row in self.printed.splitlines()[2:]:
            self.assertRegex(row, r"^\| `[a-z_.\[\]0-9]+` \| `.+` \| .* \| .* \| .{4,} \|$")


if __name__ == "__main__":
    unittest.main()
