"""Hooks of MkDocs for the documentation site (mkdocs.yml).

* A link from a page to a file outside docs/ stays as it is in the repository, where it works on GitHub. Here the file
  becomes a part of the site, at "repository/" and its path: a Markdown file as a page, an image as it is, any other
  text file as a page that shows it.
* Lists are adapted to Python-Markdown.
* KaTeX comes from Debian's package libjs-katex.
* The search index is also written as a script, because a browser does not let a page read a file from disk.
"""
import json
import os
import posixpath
import re
import warnings
from pathlib import Path
from urllib.parse import unquote

from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File

warnings.filterwarnings("ignore", "invalid escape sequence", DeprecationWarning)  # of Debian's Jinja

ROOT = Path(__file__).resolve().parents[2]
DOCS = "docs"
OUTSIDE = "repository"
KATEX = Path("/usr/share/javascript/katex")
IMAGES = {".png", ".svg", ".jpg", ".jpeg", ".gif", ".pdf"}
LANGUAGES = {".h": "cpp", ".cpp": "cpp", ".toml": "toml", ".json": "json", ".sh": "sh", ".py": "python", ".cff": "yaml",
             ".mjs": "js", ".js": "js", ".cmake": "cmake"}

# [text](target), ![text](target), [name]: target
LINK = re.compile(r"(?P<before>\]\(<?|^ {0,3}\[[^\]]+\]:[ \t]+<?)(?P<target>[^\s)>]+)", re.MULTILINE)
LIST_ITEM = re.compile(r" *([*+-]|\d+\.) ")


def find_repository_path(page: str, target: str):
    """Path in the repository that a link of a page (its path there) means, and its anchor; None where it is no file."""
    path, _, anchor = target.partition("#")
    if not path or re.match(r"[a-z][a-z0-9+.-]*:", path, re.IGNORECASE) or path.startswith("/"):
        return None
    found = posixpath.normpath(posixpath.join(posixpath.dirname(page), unquote(path)))
    if found.startswith(".."):
        return None
    if (ROOT / found).is_dir() and (ROOT / found / "README.md").is_file():
        found += "/README.md"
    return (found, anchor) if (ROOT / found).is_file() else None


def find_site_path(path: str) -> str:
    """Path of a file of the repository in the site, before MkDocs turns .md into .html."""
    if path.startswith(DOCS + "/"):
        return path[len(DOCS) + 1:]
    suffix = posixpath.splitext(path)[1]
    return posixpath.join(OUTSIDE, path if suffix == ".md" or suffix in IMAGES else path + ".md")


def find_origin(site_path: str) -> str:
    """Path in the repository of a page of the site."""
    if not site_path.startswith(OUTSIDE + "/"):
        return posixpath.join(DOCS, site_path)
    path = site_path[len(OUTSIDE) + 1:]
    return path if (ROOT / path).is_file() else path[:-len(".md")]


def list_linked(path: str):
    """Files of the repository to which a Markdown file links."""
    text = (ROOT / path).read_text(encoding="utf-8")
    for match in LINK.finditer(text):
        found = find_repository_path(path, match["target"])
        if found is not None:
            yield found[0]


def list_outside(pages):
    """Every file outside docs/ that these pages link to, and what those link to in turn."""
    outside = []
    waiting = list(pages)
    seen = set(waiting)
    while waiting:
        for path in list_linked(waiting.pop()):
            if path in seen:
                continue
            seen.add(path)
            if not path.startswith(DOCS + "/"):
                outside.append(path)
            if path.endswith(".md"):
                waiting.append(path)
    return sorted(outside)


def list_pages_of(nav):
    """Pages that the navigation names."""
    if isinstance(nav, str):
        return [nav]
    values = nav.values() if isinstance(nav, dict) else nav
    return [page for value in values for page in list_pages_of(value)]


def make_file(path: str, config) -> File:
    """A file of the repository that lies outside docs/."""
    file = File(find_site_path(path), str(ROOT), config["site_dir"], config["use_directory_urls"])
    file.abs_src_path = str(ROOT / path)
    return file


def on_files(files, config):
    pages = [find_origin(file.src_uri) for file in files.documentation_pages()]
    in_nav = [find_origin(page) for page in list_pages_of(config["nav"]) if page.startswith(OUTSIDE + "/")]
    for path in sorted(set(list_outside(pages + in_nav)) | set(in_nav)):
        files.append(make_file(path, config))
    if not (KATEX / "katex.min.js").is_file():
        raise PluginError(f"no KaTeX in {KATEX}: install the package libjs-katex")
    for file in [KATEX / "katex.min.css", KATEX / "katex.min.js", *sorted((KATEX / "fonts").iterdir())]:
        relative = file.relative_to(KATEX.parent).as_posix()
        files.append(File(relative, str(KATEX.parent), config["site_dir"], config["use_directory_urls"]))
    return files


def on_page_read_source(page, config):
    """A file that is not Markdown is shown as it is."""
    path = find_origin(page.file.src_uri)
    if path.endswith(".md"):
        return None
    text = (ROOT / path).read_text(encoding="utf-8")
    fence = "`" * (max((len(ticks) for ticks in re.findall("`+", text)), default=0) + 3)
    language = LANGUAGES.get(posixpath.splitext(path)[1], "text")
    return f"# {path}\n\nThis is a file of the repository.\n\n{fence}{language}\n{text.rstrip()}\n{fence}\n"


def adapt_lists(markdown: str) -> str:
    """Lists as Python-Markdown wants them: a blank line before, four spaces inside an item. GitHub needs neither."""
    lines = []
    fence = ""
    shift = ""
    is_in_list = False
    for line in markdown.split("\n"):
        before = lines[-1] if lines else ""
        indent = len(line) - len(line.lstrip(" "))
        ticks = re.match(r" *(`{3,}|\$\$$)", line)
        item = None if fence else LIST_ITEM.match(line)
        if item and not is_in_list and before.strip() and item[1] not in ("*", "+", "-", "1."):
            item = None  # a number at the start of a line
        if fence:
            line = shift + line
            if ticks and ticks[1].startswith(fence):
                fence = ""
        elif line.strip():
            if item and not is_in_list and before.strip() and not before.startswith((" ", "|")):
                lines.append("")
            is_in_list = bool(item) or (is_in_list and (indent > 0 or bool(before.strip())))
            starts = bool(item) or bool(ticks) or not before.strip()
            shift = " " * (4 - indent) if is_in_list and starts and 0 < indent < 4 else ""
            line = shift + line
            fence = ticks[1] if ticks else ""
        lines.append(line)
    return "\n".join(lines)


def on_page_markdown(markdown, page, config, files):
    path = find_origin(page.file.src_uri)
    if not path.endswith(".md"):
        return markdown

    def rewrite(match):
        found = find_repository_path(path, match["target"])
        if found is None:
            return match[0]
        target = posixpath.relpath(find_site_path(found[0]), posixpath.dirname(page.file.src_uri) or ".")
        return match["before"] + target + ("#" + found[1] if found[1] else "")

    return adapt_lists(LINK.sub(rewrite, markdown))


def on_post_build(config):
    site = Path(config["site_dir"])
    index = json.loads((site / "search" / "search_index.json").read_text(encoding="utf-8"))
    script = "var __search = {index: Promise.resolve(" + json.dumps(index, ensure_ascii=False) + ")};\n"
    (site / "search" / "search_index.js").write_text(script, encoding="utf-8")
    for name in ["404.html", "sitemap.xml", "sitemap.xml.gz"]:  # of no use without a server
        if (site / name).exists():
            os.remove(site / name)
