# SPDX-License-Identifier: Apache-2.0
import json
import os
import pathlib
import unittest

from support import AppTest, run

DOCS = pathlib.Path(os.environ["GEOLOC_SOURCE_DIR"]) / "docs"


def leaves(settings, path=""):
    """Every setting as (dotted path, value)."""
    for key, value in settings.items():
        if isinstance(value, dict):
            yield from leaves(value, f"{path}{key}.")
        else:
            yield f"{path}{key}", value


class SettingsReference(AppTest):
    """docs/settings.md is what the program says of itself."""

    def test_every_setting_is_listed_with_its_default(self):
        printed = run("geoloc_app", "--print-config")
        self.assertEqual(printed.status, 0, printed.err)
        reference = (DOCS / "settings.md").read_text()
        for path, value in leaves(json.loads(printed.out)):
            self.assertIn(f"| `{path}` | `{json.dumps(value)}` |", reference)

    def test_the_table_is_what_the_program_prints(self):
        printed = run("geoloc_app", "--print-settings")
        self.assertEqual(printed.status, 0, printed.err)
        self.assertIn(printed.out, (DOCS / "settings.md").read_text(),
                      "replace the first table by the output of geoloc_app --print-settings")


if __name__ == "__main__":
    unittest.main()
