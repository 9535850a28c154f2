#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures the product's sources, and fails where a function or a file is too long, or takes too many parameters.

    tests/measures.py            says where, and nothing else
    tests/measures.py --count    lines of the product, the longest file, how many functions are too long or too wide
    tests/measures.py --list N   also each function of more than N lines

A function's lines are those from the first of its signature to its closing brace. Lambdas and local classes in it belong to
it; the parameters of lambdas are counted for themselves. What has one line for each case and nothing to split into counts as
a table; these are listed below.
"""
import ast
import collections
import pathlib
import re
import sys

LONGEST_FUNCTION = 80
LONGEST_FILE = 700
MOST_PARAMETERS = 6
TABLES = {
    # The C function of alembert_series_table, with one more argument in the register that its machine code fills.
    ("generator/codegen/machine/memory_series.cpp", "expand"),
    # The arguments that Python's `simulate` hands over, one by one.
    ("python/module.cpp", "add_answers (lambda)"),
}

Function = collections.namedtuple("Function", "file line name lines parameters")
PLACES = ("lib", "generator", "python", "templates")
KINDS = {".cpp", ".hpp", ".py", ".js", ".css", ".mustache"}


def sources(root):
    for place in PLACES:
        for path in sorted((root / place).rglob("*")):
            name = path.relative_to(root).as_posix()
            if path.suffix in KINDS and not name.startswith("generator/plugins/"):
                yield name, path.read_text(encoding="utf-8")


TOKEN = re.compile(
    r"""(?P<comment>//[^\n]*|/\*.*?\*/)
      | (?P<raw>\bu?8?R"(?P<mark>[^()\\\s]*)\(.*?\)(?P=mark)")
      | (?P<text>"(?:\\.|[^"\\\n])*")
      | (?P<digits>\b\d[\w.']*)
      | (?P<letter>'(?:\\.|[^'\\\n])*')
      | (?P<directive>(?m:^)[ \t]*\#(?:\\\n|[^\n])*)""",
    re.S | re.X,
)


def without_texts(source):
    """The source with comments, texts and preprocessor lines blank, at the same places."""

    def blank(found):
        if found.lastgroup == "digits":
            return found[0].replace("'", "0")
        hidden = re.sub(r"[^\n]", " ", found[0])
        return hidden if found.lastgroup in ("comment", "directive") else '"' + hidden[1:-1] + '"'

    return TOKEN.sub(blank, source)


BRACKET = re.compile(r"[(\[{]|([)\]}])")


def closing(text, start):
    """The place of the bracket that closes the one at start."""
    depth = 0
    for found in BRACKET.finditer(text, start):
        depth += -1 if found[1] else 1
        if depth == 0:
            return found.start()
    raise ValueError("a bracket is not closed")


def without_templates(head):
    """The head of a definition without template <...> and attributes."""
    while found := re.search(r"\btemplate\s*<", head):
        depth, at = 0, found.end() - 1
        while True:
            depth += {"<": 1, ">": -1}.get(head[at], 0)
            if depth == 0:
                break
            at += 1
        head = head[: found.start()] + " " * (at + 1 - found.start()) + head[at + 1 :]
    return re.sub(r"\[\[.*?\]\]", lambda found: " " * len(found[0]), head)


def parameters(between):
    """How many parameters stand in the text between the brackets of a function."""
    if between.strip() in ("", "void"):
        return 0
    depth, count = 0, 1
    for before, letter in zip(" " + between, between):
        depth += letter in "([{<"
        depth -= letter in ")]}" or (letter == ">" and before != "-")
        count += letter == "," and depth == 0
    return count


SCOPE = re.compile(
    r"""\s*(struct|class|union)\b(?!.*\)\s*(const)?\s*$)
      | .*\bnamespace\b[\w:\s]*$
      | \s*extern\s*"[ ]*"\s*$""",
    re.S | re.X,
)
MARK = re.compile(r"[(\[{};:]")
OPERATOR = re.compile(r"\boperator\s*(\(\s*\)|\[\s*\]|[^\s\w(]+)")


def functions(text, start, end):
    """Yields (first, open, last, name, parameters) of each function between the places."""
    at = head_at = start
    while found := MARK.search(text, at, end):
        at = found.start()
        letter = text[at]
        if letter in "([":
            at = closing(text, at)
        elif letter in ";}":
            head_at = at + 1
        elif letter == ":" and re.fullmatch(r"\s*(public|private|protected)\s*", text[head_at:at]):
            head_at = at + 1
        elif letter == "{":
            head = without_templates(text[head_at:at])
            head = OPERATOR.sub(lambda found: "operator" + "_" * (len(found[0]) - 8), head)
            last = closing(text, at)
            if SCOPE.match(head):
                yield from functions(text, at + 1, last)
                head_at = last + 1
            else:
                list_of = signature(head)
                if list_of:
                    opened, name = list_of
                    if in_initialisers(head, closing(head, opened)):
                        at = last + 1
                        continue
                    while handler := re.compile(r"\s*catch\s*(?=\()").match(text, last + 1):
                        last = closing(text, text.index("{", closing(text, handler.end())))
                    first = head_at + len(text[head_at:at]) - len(text[head_at:at].lstrip())
                    inside = head[opened + 1 : closing(head, opened)]
                    yield first, at, last, name, parameters(inside)
                    head_at = last + 1
            at = last
        at += 1


def without_arguments(name):
    """The name of a template's specialisation without <...>."""
    depth, at = 0, len(name)
    while at > 0 and (depth > 0 or name[at - 1] == ">"):
        at -= 1
        depth += {">": 1, "<": -1}.get(name[at], 0)
    return name[:at]


def signature(head):
    """Where the parameters of a function's head open, and its name; nothing if this is no function."""
    at = 0
    while at < len(head):
        if head[at] == "=":
            found = re.search(r"([A-Za-z_]\w*)\s*=\s*\[", head)  # a lambda with a name
            if not found:
                return None
            capture = closing(head, found.end() - 1)
            opened = head.find("(", capture)
            return (opened, found[1]) if opened >= 0 else None
        if head[at] == "(":
            found = re.search(r"(~?[A-Za-z_][\w:~<>, ]*?)\s*$", head[:at])
            name = found and re.search(r"[\w:~]+$", without_arguments(found[1]))
            if name and name[0] not in ("requires", "decltype", "noexcept", "alignas", "explicit"):
                return at, name[0]
            at = closing(head, at)
        at += 1
    return None


def in_initialisers(head, closed):
    """Whether the brace after the head opens a member's value in a constructor's list of initialisers."""
    after = re.sub(r"::", "  ", head[closed + 1 :])
    return bool(re.match(r"[^;]*?(?<!:):(?!:)", after)) and bool(re.search(r"[\w>]\s*$", after))


def lambdas(text, start, end):
    """Yields (place, parameters) of each lambda between the places."""
    for found in re.finditer(r"(?<![\w)\]])\s*\[", text[start:end]):
        capture = closing(text, start + found.end() - 1)
        opened = re.match(r"\s*\(", text[capture + 1 : end])
        if opened:
            opened = capture + opened.end()
            shut = closing(text, opened)
            if re.match(r"\s*(mutable\b|noexcept\b|->[^;{]*)?\s*\{", text[shut + 1 : end]):
                yield start + found.end() - 1, parameters(text[opened + 1 : shut])


def measured(name, source):
    """Yields each function of a file."""
    if name.endswith(".py"):
        for node in ast.walk(ast.parse(source)):
            if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
                in_order = node.args.posonlyargs + node.args.args  # those that are named in a call may be many
                yield Function(name, node.lineno, node.name, node.end_lineno - node.lineno + 1, len(in_order))
    elif name.endswith((".cpp", ".hpp")):
        text = without_texts(source)
        for first, opened, last, called, count in functions(text, 0, len(text)):
            lines = text.count("\n", first, last) + 1
            yield Function(name, text.count("\n", 0, first) + 1, called, lines, count)
            for place, inner in lambdas(text, opened, last):
                yield Function(name, text.count("\n", 0, place) + 1, called + " (lambda)", 0, inner)


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    files = list(sources(root))
    sizes = {name: source.count("\n") for name, source in files}
    found = [function for name, source in files for function in measured(name, source)]
    judged = [f for f in found if (f.file, f.name) not in TABLES]
    long = [f for f in judged if f.lines > LONGEST_FUNCTION]
    wide = [f for f in judged if f.parameters > MOST_PARAMETERS]
    if "--count" in sys.argv:
        longest = max(sizes, key=sizes.get)
        print(f"{sum(sizes.values())} lines in {len(sizes)} files; the longest, {longest}, has {sizes[longest]}")
        print(f"{len(found)} functions and lambdas: {len(long)} have more than {LONGEST_FUNCTION} lines, "
              f"{len(wide)} more than {MOST_PARAMETERS} parameters, apart from {len(TABLES)} tables")
    if "--list" in sys.argv:
        least = int(sys.argv[sys.argv.index("--list") + 1])
        for f in sorted(found, key=lambda f: -f.lines):
            if f.lines > least:
                print(f"{f.lines:5} lines  {f.file}:{f.line}: {f.name}")
    failures = [f"{f.file}:{f.line}: {f.name} has {f.lines} lines; at most {LONGEST_FUNCTION}" for f in long]
    failures += [f"{f.file}:{f.line}: {f.name} has {f.parameters} parameters; at most {MOST_PARAMETERS}" for f in wide]
    failures += [f"{name} has {lines} lines; at most {LONGEST_FILE}"
                 for name, lines in sizes.items() if lines > LONGEST_FILE]
    for failure in failures:
        print(failure)
    return 1 if failures else 0


sys.exit(main())
