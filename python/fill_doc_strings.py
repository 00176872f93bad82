"""Copies the Python files of a folder and fills their doc strings from the C++ headers.

Call: fill_doc_strings.py HEADERS FROM TO

A line ":api NAME" of a doc string becomes the comment of a function, a struct or a class of the headers; of a member
function, NAME is Class::member. A line ":members STRUCT" becomes a list of the function's arguments that are members
of that struct, each with its comment.
"""

import ast
import pathlib
import re
import shutil
import sys
import textwrap

COMMENT = re.compile(r"^\s*/// ?(.*)$")
DECLARATION = re.compile(r"^\s*(?:explicit )?(?:(?:struct|class|enum class) (\w+)|(?:[\w:<>,&*\s]+[\s&*])?(\w+)\()")
OPENING = re.compile(r"^(?:struct|class) (\w+)[^;]*\{")
MEMBER = re.compile(r"^\s+[\w:<>,\s]+?\b(\w+(?:, \w+)*)(?:\s*=\s*[^;]*|\{[^;]*\})?;\s*(?://\s*(.*))?$")
GOES_ON = re.compile(r"^\s+//(?!/)\s*(.*)$")
WIDTH = 100


class Headers:
    """Comments of functions, structs and classes by name, and those of members by (struct, member)."""

    def __init__(self, folder):
        self.comments = {}
        self.members = {}
        for path in sorted(pathlib.Path(folder).glob("*.h")):
            self.read(path.read_text().splitlines())

    def read(self, lines):
        inside, comment, last_members = None, [], []
        for line in lines:
            opening = OPENING.match(line)
            if found := COMMENT.match(line):
                comment.append(found.group(1))
                continue
            if opening and "}" not in line:
                inside = opening.group(1)
            if line.startswith("}"):
                inside = None
            declared = DECLARATION.match(line)
            if declared and comment:
                name = declared.group(1) or declared.group(2)
                known = f"{inside}::{name}" if inside and not opening else name
                self.comments.setdefault(known, comment)
            member = MEMBER.match(line) if inside else None
            if member:
                last_members = [(inside, name.strip()) for name in member.group(1).split(",")]
                for key in last_members:
                    self.members[key] = member.group(2) or " ".join(comment)
            elif (going_on := GOES_ON.match(line)) and last_members:
                for key in last_members:
                    self.members[key] += " " + going_on.group(1)
            else:
                last_members = []
            comment = []


def speak_python(text):
    """The words of Python for those of C++."""
    for cpp, python in [(r"\bThrows\b", "Raises"), (r"\bInterrupted\b", "KeyboardInterrupt"),
                        (r"\b(empty|absent|none): ", "None: ")]:
        text = re.sub(cpp, python, text)
    return text


def make_api(headers, name):
    """The comment; a heading such as Errors begins a paragraph of its own. Examples are in C++ and left out."""
    paragraphs = [[]]
    for line in headers.comments[name]:
        if re.match(r"[A-Z]\w+  +\S", line):
            paragraphs.append([re.sub(r"  +", ": ", line, count=1)])
        else:
            paragraphs[-1].append(line.strip())
    texts = [speak_python(" ".join(paragraph)) for paragraph in paragraphs if paragraph]
    return "\n\n".join(textwrap.fill(text, WIDTH) for text in texts if not text.startswith("Example: "))


def make_members(headers, struct, arguments):
    lines = []
    for (owner, member), text in headers.members.items():
        if owner == struct and member in arguments and text:
            said = f"{member}: {speak_python(text)}"
            lines.append(textwrap.fill(said, WIDTH, initial_indent="* ", subsequent_indent="  "))
    if not lines:
        raise SystemExit(f"fill_doc_strings: no argument is a member of {struct}")
    return "\n".join(lines)


def fill_line(headers, line, arguments):
    words = line.split()
    if words[:1] == [":api"]:
        return make_api(headers, words[1])
    if words[:1] == [":members"]:
        return make_members(headers, words[1], arguments)
    return line


def fill(headers, source):
    """The source with its doc strings filled; what is outside of doc strings stays as it is."""
    lines = source.splitlines()
    nodes = [node for node in ast.walk(ast.parse(source)) if isinstance(node, (ast.FunctionDef, ast.ClassDef))]
    for node in sorted(nodes, key=lambda node: -node.lineno):
        doc = ast.get_docstring(node)
        if doc is None or not re.search(r"^:(api|members) ", doc, re.MULTILINE):
            continue
        arguments = set()
        if isinstance(node, ast.FunctionDef):
            arguments = {argument.arg for argument in node.args.args + node.args.kwonlyargs}
        text = "\n".join(fill_line(headers, line, arguments) for line in doc.splitlines())
        place = node.body[0]
        indent = " " * place.col_offset
        quoted = textwrap.indent('"""' + text.replace("\\", "\\\\") + '\n"""', indent, lambda line: line.strip())
        lines[place.lineno - 1:place.end_lineno] = quoted.splitlines()
    return "\n".join(lines) + "\n"


def main(header_folder, source_folder, target_folder):
    headers = Headers(header_folder)
    target = pathlib.Path(target_folder)
    target.mkdir(parents=True, exist_ok=True)
    for former in target.glob("*.py"):
        former.unlink()
    for source in sorted(pathlib.Path(source_folder).iterdir()):
        if source.suffix == ".py":
            (target / source.name).write_text(fill(headers, source.read_text()))
        elif source.is_file():
            shutil.copy(source, target)


if __name__ == "__main__":
    main(*sys.argv[1:])
