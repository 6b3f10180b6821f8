# SPDX-License-Identifier: Apache-2.0
"""check.py SITE: nothing in the site is fetched from elsewhere, every link in it leads somewhere (headings of Doxygen's pages are its own
matter), and its search knows what is in it."""

import html.parser
import json
import pathlib
import re
import sys
import urllib.parse

LOADING = {"script": "src", "img": "src", "iframe": "src", "source": "src", "link": "href", "object": "data", "embed": "src"}
NOT_LOADED = {"canonical", "next", "prev", "alternate"}
MUST_BE_FOUND = {"joint.max_tracks": "docs/settings.html", "memory_needed": "docs/library.html", "add_attitude": "api/python.html"}


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.anchors, self.links, self.loads = set(), set(), set()
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        given = dict(attrs)
        self.anchors |= {given[name] for name in ("id", "name") if given.get(name)}
        if tag == "a" and given.get("href"):
            self.links.add(given["href"])
        address = given.get(LOADING.get(tag))
        if address and given.get("rel") not in NOT_LOADED:
            self.loads.add(address)


def is_elsewhere(address):
    return re.match(r"(?i)(https?:)?//", address) is not None


def faults_of(site):
    pages = {path: Page(path.read_text(errors="replace")) for path in site.rglob("*.html")}
    for path, page in pages.items():
        for address in sorted(filter(is_elsewhere, page.loads)):
            yield f"{path} loads {address}"
        for link in sorted(page.links | page.loads):
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc or path.name == "404.html":
                continue
            target = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
            target = target / "index.html" if target.is_dir() else target
            if not target.exists():
                yield f"{path} links to {link}"
            elif parts.fragment and target in pages and "api/cpp" not in str(path) and urllib.parse.unquote(parts.fragment) not in pages[target].anchors:
                yield f"{path} links to {link}, where there is no such heading"
    for path in site.rglob("*.css"):
        for address in re.findall(r"url\(\s*['\"]?([^)'\"]+)|@import\s+['\"]([^'\"]+)", path.read_text(errors="replace")):
            if is_elsewhere(address[0] or address[1]):
                yield f"{path} loads {address}"
    known = json.loads((site / "search/search_index.json").read_text())["docs"]
    for word, page in MUST_BE_FOUND.items():
        if not any(entry["location"].startswith(page) and word in entry["title"] + entry["text"] for entry in known):
            yield f"a search for {word} does not find {page}"


if __name__ == "__main__":
    faults = sorted(faults_of(pathlib.Path(sys.argv[1]).resolve()))
    print("\n".join(faults), file=sys.stderr)
    sys.exit(bool(faults))
