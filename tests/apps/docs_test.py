# SPDX-License-Identifier: Apache-2.0
import json
import os
import pathlib
import re
import sys
import unittest

from support import AppTest, run

SOURCE = pathlib.Path(os.environ["GEOLOC_SOURCE_DIR"])
DOCS = SOURCE / "docs"
PAGES = sorted(page for folder in (".", "docs", "bench", "data", "examples", "tests", "tools")
               for page in (SOURCE / folder).glob("*.md" if folder == "." else "**/*.md"))
sys.path.insert(0, str(SOURCE / "scripts"))
from settings_tables import PAGE, with_tables  # noqa: E402


def leaves(settings, path=""):
    """Every setting as (dotted path, value)."""
    for key, value in settings.items():
        if isinstance(value, dict) and value:
            yield from leaves(value, f"{path}{key}.")
        else:
            yield f"{path}{key}", value


def without_code(text):
    """A page without its code blocks, whose lines may look like headings and links."""
    return re.sub(r"^```.*?^```$", "", text, flags=re.MULTILINE | re.DOTALL)


def headings(page):
    """The headings of a page as (level, text)."""
    found = re.findall(r"^(#+) (.*)$", without_code(page.read_text()), re.MULTILINE)
    return [(len(marks), text) for marks, text in found]


def anchor(heading):
    """The anchor that GitHub gives a heading."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def rows(page, block=None):
    """The cells of every row of every table of a page, or of a block that scripts/results.sh fills, without emphasis."""
    text = page.read_text()
    if block:
        text = text[text.index(f"<!-- begin {block} -->"):text.index(f"<!-- end {block} -->")]
    for line in text.splitlines():
        if line.startswith("| "):
            yield [cell.strip(" *") for cell in line.strip("|").split("|")]


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


class Pages(unittest.TestCase):
    """Readers find their way through README.md, docs/ and the README files of the folders."""

    def test_every_page_has_one_title(self):
        for page in PAGES:
            self.assertEqual([level for level, _ in headings(page)].count(1), 1, page)

    def test_every_relative_link_leads_to_a_file_and_a_heading(self):
        for page in PAGES:
            text = without_code(page.read_text())
            for link in re.findall(r"\]\(([^)\s]+)\)", text) + re.findall(r'<img\s+src="([^"]+)"', text):
                if re.match(r"\w+:", link):
                    continue  # an address on the internet
                path, _, fragment = link.partition("#")
                target = page.parent / path if path else page
                self.assertTrue(target.exists(), f"{page}: {link}")
                if fragment:
                    self.assertIn(fragment, [anchor(text) for _, text in headings(target)], f"{page}: {link}")

    def test_every_page_is_in_the_sites_navigation(self):
        navigation = (SOURCE / "packaging/site/mkdocs.yml").read_text().splitlines()
        for page in DOCS.glob("*.md"):
            self.assertTrue(any(line.endswith(f": docs/{page.name}") for line in navigation), page)


class AccuracyFigures(unittest.TestCase):
    """An accuracy is quoted as docs/results.md has it, which scripts/results.sh writes."""

    # Phrases that quote figures, by page: {stock paper rmse} is that of a set and method, {Height 80 joint rmse} that of a
    # sweep, its value and a method.
    QUOTES = {
        "docs/flying.md": ["{gnss joint rmse:.2f} m becomes {gnss joint, 2 known points rmse:.2f} m"],
        "docs/method.md": ["{stock paper rmse:.3f} m and {stock paper found:.0f} of {stock paper targets:.0f} targets",
                           "With telemetry at 2 Hz `joint` has {Telemetry rate 2 joint rmse:.3f} m on the stock flights",
                           "from 0.186 to {Height 80 joint rmse:.3f} m and the NEES from 6.3 to {Height 80 joint nees:.1f}"],
    }

    def setUp(self):
        self.measured = {}  # cells from RMSE to merged pairs, by set and method
        for cells in rows(DOCS / "results.md", "table"):
            if cells[0] in ("stock", "gnss"):
                self.measured[cells[0], cells[1]] = cells[3:8]
        self.assertEqual(len(self.measured), 6)
        self.of_others = {(cells[0], cells[1]): cells[3:8] for cells in rows(SOURCE / "bench/peers/README.md")
                          if cells[0] in ("stock", "gnss") and len(cells) == 9}

    def test_readme_has_the_rows_of_the_results_and_of_the_peers(self):
        quoted = {(cells[0], cells[1]): cells[2:7] for cells in rows(SOURCE / "README.md")
                  if cells[0] in ("stock", "gnss")}
        self.assertEqual(len(quoted), 9)
        for key, figures in quoted.items():
            self.assertEqual(figures, {**self.of_others, **self.measured}[key], key)

    def test_the_peers_page_has_the_rows_of_the_results(self):
        for flights in "stock", "gnss":
            for method in "paper", "joint":
                self.assertEqual(self.of_others[flights, f"geoloc {method}"], self.measured[flights, method])

    def test_phrases_quote_the_results(self):
        figures = self.figures()
        for page, phrases in self.QUOTES.items():
            text = " ".join((SOURCE / page).read_text().split())
            for phrase in phrases:
                self.assertIn(phrase.format_map(figures), text, page)

    def figures(self):
        """Every figure of docs/results.md by the name that QUOTES gives it."""
        figures = {}
        for (flights, method), (rmse, _, found, *_) in self.measured.items():
            figures[f"{flights} {method} rmse"] = float(rmse)
            figures[f"{flights} {method} found"], figures[f"{flights} {method} targets"] = map(int, found.split("/"))
        sections = re.findall(r"^([\w\-', ]+) \(usually .*\)\n\n((?:\|.*\n)+)", (DOCS / "results.md").read_text(), re.MULTILINE)
        self.assertEqual(len(sections), 20)
        for sweep, table in sections:
            for value, method, rmse, *_, nees in re.findall(r"^\| ([-\d.]+) \| (\w+) \| ([\d.]+) \|.* ([\d.]+) \|$", table, re.MULTILINE):
                figures[f"{sweep} {value} {method} rmse"], figures[f"{sweep} {value} {method} nees"] = float(rmse), float(nees)
        return figures


if __name__ == "__main__":
    unittest.main()
