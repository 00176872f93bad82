#!/usr/bin/env python3
"""Checks that a built site works from disk: every href, src and #anchor in its HTML and every url() in its CSS exists.

check_links.py FOLDER; exit status 1 if a link is dead or if a page would load something from the network.
"""
import os
import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

# Attributes by which a browser loads something without being asked.
LOADED = {("img", "src"), ("script", "src"), ("iframe", "src"), ("source", "src"), ("link", "href"), ("object", "data")}
CSS_URL = re.compile(r"""url\(\s*['"]?([^'")]+)""")


class Page(HTMLParser):
    """Links of a page, and the anchors that it has."""

    def __init__(self):
        super().__init__()
        self.links = []  # line, target, whether it is loaded
        self.anchors = set()

    def handle_starttag(self, tag, attrs):
        for name, value in attrs:
            if name == "id" or (tag == "a" and name == "name"):
                self.anchors.add(value)
            elif name in ("href", "src", "data") and value is not None:
                self.links.append((self.getpos()[0], value, (tag, name) in LOADED))


def read_page(path: Path) -> Page:
    page = Page()
    page.feed(path.read_text(encoding="utf-8"))
    return page


def find_problem(path: Path, target: str, is_loaded: bool, pages: dict):
    """What is wrong with a link; None where it is good."""
    parts = urlsplit(target)
    if parts.scheme == "data":
        return None
    if parts.scheme or parts.netloc:
        return "is loaded from the network" if is_loaded else None
    if parts.path.startswith("/"):
        return "begins at the root of a server"
    file = Path(os.path.normpath(path.parent / unquote(parts.path))) if parts.path else path
    if not file.is_file():
        return "is a folder" if file.is_dir() else "is not there"
    if parts.fragment and file in pages and unquote(parts.fragment) not in pages[file].anchors:
        return "has no such anchor"
    return None


def check(folder: Path):
    """All problems of a site, as lines; and how many links there are."""
    pages = {path: read_page(path) for path in sorted(folder.rglob("*.html"))}
    links = [(path, line, target, loaded) for path, page in pages.items() for line, target, loaded in page.links]
    for path in sorted(folder.rglob("*.css")):
        links += [(path, 1, target, True) for target in CSS_URL.findall(path.read_text(encoding="utf-8"))]
    problems = []
    for path, line, target, is_loaded in links:
        problem = find_problem(path, target, is_loaded, pages)
        if problem is not None:
            problems.append(f"{path.relative_to(folder)}, line {line}: {target} {problem}")
    return problems, len(pages), len(links)


def main() -> int:
    if len(sys.argv) != 2 or not Path(sys.argv[1]).is_dir():
        print("usage: check_links.py FOLDER", file=sys.stderr)
        return 2
    problems, pages, links = check(Path(sys.argv[1]).resolve())
    for problem in sorted(set(problems)):
        print(problem)
    print(f"{links} links on {pages} pages, {len(set(problems))} dead")
    return 1 if problems or not pages else 0


if __name__ == "__main__":
    sys.exit(main())
