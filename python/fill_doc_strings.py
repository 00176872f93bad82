"""Copies the Python files of a folder and fills their doc strings from the C++ headers.

Call: fill_doc_strings.py HEADERS FROM TO

A line ":api NAME" of a doc string becomes the comment of a function, a struct or a class of the headers; of a member
function, NAME is Class::member.

A line ":members STRUCT" becomes a list of the function's arguments that are members of that struct, each with its
comment. Where the default of Python is None, it also tells that of the struct, else the rest of the line. Left out are
arguments of which the doc string has a line of its own ("* name: ..."). Arguments of which nothing is said then get
their line of COMMON.
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
MEMBER = re.compile(r"^\s+[\w:<>,\s]+?\b(\w+(?:, \w+)*)(?:\s*=\s*([^;]*)|\{[^;]*\})?;\s*(?://\s*(.*))?$")
SAID = re.compile(r"^\* ([\w, ]+):", re.MULTILINE)
GOES_ON = re.compile(r"^\s+//(?!/)\s*(.*)$")
WIDTH = 100
# Arguments that mean the same in all functions.
COMMON = {
    "force": "whether a folder that holds files is written into.",
    "monte_carlo": "number of trials that check the uncertainty budget; 0: none.",
    "progress": "True shows a bar, False none; None shows a bar in Jupyter alone. A function is called with the share "
                "done (0 to 1, NaN if unknown) and the stage as text.",
    "rig": "name of an asset, or a path; None: that of the scenario.",
    "scenario": "name of a scenario, or path of a run file (.toml).",
    "settings": "any setting of the scenario by its name, such as pressure_kPa=210; describe(scenario) lists them. A "
                'dict changes a value of a file or an effect: effects={"bearing_warmup": {"fall_per_K": 0.02}}, or '
                '**{"tire.thermal.heat_capacity_J_per_K": 12000}.',
    "skip_bad_rows": "whether rows that cannot be used are left out instead of refused.",
    "threads": "0: as many as the machine has.",
    "uncertainty": "whether the uncertainty budget of the results is wanted.",
    "vehicle": "name of an asset, or a path; None: that of the scenario.",
}


class Headers:
    """Comments of functions, structs and classes by name, and those of members by (struct, member)."""

    def __init__(self, folder):
        self.comments = {}
        self.members = {}
        self.defaults = {}
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
                    self.members[key] = member.group(3) or " ".join(comment)
                    self.defaults[key] = write_default(member.group(2) or "")
            elif (going_on := GOES_ON.match(line)) and last_members:
                for key in last_members:
                    self.members[key] += " " + going_on.group(1)
            else:
                last_members = []
            comment = []


def write_default(expression):
    """The value of a number or a text; empty for all else."""
    if "infinity()" in expression:
        return "no limit"
    if re.fullmatch(r'".+"', expression):
        return expression
    if not re.fullmatch(r"[\d.e\-+*/ ]+", expression) or float(eval(expression)) == 0.0:  # 0 stands for none
        return ""
    return f"{eval(expression):.6g}"


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


def make_line(name, said):
    return textwrap.fill(f"{name}: {said}", WIDTH, initial_indent="* ", subsequent_indent="  ")


def make_members(headers, struct, arguments, is_said, usual):
    """A line for each member that is an argument of which nothing is said yet. `arguments`: whether None is default."""
    lines = []
    for (owner, member), text in headers.members.items():
        if owner != struct or member not in arguments or member in is_said:
            continue
        said = [speak_python(text)] if text else []
        default = headers.defaults[owner, member] or (usual if said else "")
        if arguments[member] and default and "None: " not in "".join(said):
            said.append("None: " + default)
        if said:
            lines.append(make_line(member, "; ".join(said)))
    if not lines:
        raise SystemExit(f"fill_doc_strings: no argument is a member of {struct}")
    return "\n".join(lines)


def list_said(text):
    return {name.strip() for names in SAID.findall(text) for name in names.split(",")}


def fill_line(headers, line, arguments, is_said):
    words = line.split()
    if words[:1] == [":api"]:
        return make_api(headers, words[1])
    if words[:1] == [":members"]:
        return make_members(headers, words[1], arguments, is_said, " ".join(words[2:]))
    return line


def list_arguments(function):
    """By name whether the default is None."""
    given = function.args
    with_default = [*zip(reversed(given.args), reversed(given.defaults)), *zip(given.kwonlyargs, given.kw_defaults)]
    none = {argument.arg for argument, value in with_default if isinstance(value, ast.Constant) and value.value is None}
    return {argument.arg: argument.arg in none for argument in given.args + given.kwonlyargs}


def list_names(node):
    """Of the arguments of a function, as help() shows them."""
    if not isinstance(node, ast.FunctionDef):
        return []
    given = node.args
    return [at.arg for at in given.args + given.kwonlyargs + ([given.kwarg] if given.kwarg else [])]


def put_in_order(text, names):
    """The text, and then its lines on arguments in the order of the arguments."""
    about = re.findall(r"^\* [\w, ]+: .*(?:\n  .*)*", text, re.MULTILINE)
    if not about or not names:
        return text
    for lines in about:
        text = text.replace(lines, "", 1)
    about.sort(key=lambda lines: names.index(SAID.match(lines).group(1).split(",")[0]))
    return re.sub(r"\n{3,}", "\n\n", text).strip() + "\n\n" + "\n".join(about)


def fill(headers, source):
    """The source with its doc strings filled; what is outside of doc strings stays as it is."""
    lines = source.splitlines()
    nodes = [node for node in ast.walk(ast.parse(source)) if isinstance(node, (ast.FunctionDef, ast.ClassDef))]
    for node in sorted(nodes, key=lambda node: -node.lineno):
        doc = ast.get_docstring(node)
        if doc is None or not re.search(r"^:(api|members) ", doc, re.MULTILINE):
            continue
        arguments = list_arguments(node) if isinstance(node, ast.FunctionDef) else {}
        text = "\n".join(fill_line(headers, line, arguments, list_said(doc)) for line in doc.splitlines())
        missing = [name for name in list_names(node) if name in COMMON and name not in list_said(text)]
        text = put_in_order("\n".join([text] + [make_line(name, COMMON[name]) for name in missing]), list_names(node))
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
