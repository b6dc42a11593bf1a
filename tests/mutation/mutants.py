# SPDX-License-Identifier: GPL-3.0-or-later
"""Mutants of the library: one operator, constant or keyword of one line is another, once a switch is on."""
import dataclasses
import pathlib
import random
import re

# Floors from below; `io` stands beside them.
FOLDERS = ["mesh", "triangles", "volumes", "partition", "particles", "tree", "bounds", "filter", "queries", "detection",
           "io"]

# Lines whose mutants say nothing about behaviour.
SKIPPED = re.compile(r"^\s*(#|template|using|static_assert|namespace|requires|concept|typedef|friend)|concept |operator")


@dataclasses.dataclass
class Mutant:
    """What stands in `text[begin:end]` of a file is replaced by `switched`, in which %d is the mutant's number."""
    file: str
    line: int
    kind: str  # such as "< to <="
    original: str  # the line
    begin: int
    end: int
    switched: str
    number: int = 0

    def __str__(self):
        return f"{self.file}:{self.line}: {self.kind} in: {self.original}"


def infix(operator, other):
    """An operator of two operands, written between blanks."""
    before = r"(?<=[\w)\]] )" if operator in ("<", ">", "<=", ">=", "+", "-", "*", "/") else r"(?<= )"
    return (rf"{before}{re.escape(operator)}(?= )", f"{operator} to {other}",
            lambda text, match: (*match.span(), f"{operator} ::lodestone_mutation::operation<%d> {operator}"))


def word(pattern, kind, switched):
    return pattern, kind, lambda text, match: (*match.span(), switched(match))


def logical(operator, other):
    def switch(text, match):
        begin, end = left_operand(text, match.start()), right_operand(text, match.end())
        left, right = text[begin:match.start()].strip(), text[match.end():end].strip()
        if not left or not right or "//" in left + right:
            return None
        switched = f"(::lodestone_mutation::on(%d) ? ({left} {other} {right}) : ({left} {operator} {right}))"
        # All lines keep their numbers, by which errors are told.
        return begin, end, switched.replace("\n", " ") + "\n" * text.count("\n", begin, end)
    return rf"(?<= ){re.escape(operator)}(?= )", f"{operator} to {other}", switch


def member(name, other):
    def switch(text, match):
        begin = postfix_operand(text, match.start())
        value = text[begin:match.start()]
        if not value:
            return None
        return begin, match.end(), f"(::lodestone_mutation::on(%d) ? {value}.{other}() : {value}.{name}())"
    return rf"\.{name}\(\)", f"{name} to {other}", switch


NUMBER = r"(?<![\w.']){}(?![\w.'])"
ON = "::lodestone_mutation::on(%d)"
RULES = [(re.compile(pattern), kind, switch) for pattern, kind, switch in [
    infix("<=", "<"), infix(">=", ">"), infix("<", "<="), infix(">", ">="), infix("==", "!="), infix("!=", "=="),
    infix("+", "-"), infix("-", "+"), infix("*", "/"), infix("/", "*"), infix("+=", "-="), infix("-=", "+="),
    logical("&&", "||"), logical("||", "&&"), member("front", "back"), member("back", "front"),
    word(r"\btrue\b", "true to false", lambda match: f"(!{ON})"),
    word(r"\bfalse\b", "false to true", lambda match: ON),
    word(r"\bstd::min\b(?=[(<])", "min to max", lambda match: "::lodestone_mutation::Least<%d>::of"),
    word(r"\bstd::max\b(?=[(<])", "max to min", lambda match: "::lodestone_mutation::Greatest<%d>::of"),
    word(r"\bcontinue;", "continue to break", lambda match: f"{{ if ({ON}) break; continue; }}"),
    word(r"\bbreak;", "break to continue", lambda match: f"{{ if ({ON}) continue; break; }}"),
    word(NUMBER.format("0"), "0 to 1", lambda match: f"({ON} ? 1 : 0)"),
    word(NUMBER.format("1"), "1 to 2", lambda match: f"({ON} ? 2 : 1)"),
    word(NUMBER.format(r"([2-9]|\d\d+)"), "N to N + 1", lambda match: f"({ON} ? {match[1]} + 1 : {match[1]})"),
    word(r"!(?=[a-z_(])", "! dropped", lambda match: "::lodestone_mutation::operation<%d>->*"),
]]

OPENING, CLOSING = "([{", ")]}"


def left_operand(text, position):
    """Where the left operand of && or || begins."""
    depth = 0
    while position > 0:
        before = text[position - 1]
        if before in CLOSING:
            depth += 1
        elif before in OPENING:
            if depth == 0:
                return position
            depth -= 1
        elif depth == 0 and ends_operand(text, position - 1):
            return position
        elif depth == 0 and text[:position].endswith("return "):
            return position
        position -= 1
    return position


def right_operand(text, position):
    """Where the right operand of && or || ends."""
    depth = 0
    while position < len(text):
        if text[position] in OPENING:
            depth += 1
        elif text[position] in CLOSING:
            if depth == 0:
                return position
            depth -= 1
        elif depth == 0 and ends_operand(text, position):
            return position
        position += 1
    return position


def ends_operand(text, position):
    """Whether the character belongs to something that binds less than && and ||, or as they do."""
    character, around = text[position], text[position - 1:position + 2]
    if character in ";,?":
        return True
    if character == ":":
        return "::" not in around
    if character == "=":
        return re.search(r"[=!<>+\-*/]=|==", around) is None
    return "&&" in around and around != " & " or "||" in around


def postfix_operand(text, position):
    """Where the operand in front of .front() begins: names, calls and subscripts, joined by dots and arrows."""
    while position > 0:
        before = text[position - 1]
        if before in ")]":
            depth = 0
            while position > 0:
                position -= 1
                depth += (text[position] in CLOSING) - (text[position] in OPENING)
                if depth == 0:
                    break
        elif before.isalnum() or before in "_.:":
            position -= 1
        elif text[:position].endswith("->"):
            position -= 2
        else:
            break
    return position


def code_of(line):
    """The line without its comment and with blanked strings, of the same length up to the comment."""
    line = re.sub(r'"(\\.|[^"\\])*"', lambda text: '"' + "." * (len(text.group()) - 2) + '"', line)
    return line.split("//")[0]


def library_files(root):
    files = [path.relative_to(root) for folder in ("include/lodestone", "src") for path in (root / folder).rglob("*")
             if path.suffix in (".h", ".cpp")]
    return sorted(str(path) for path in files if folder_of(path) in FOLDERS)


def folder_of(file):
    parts = pathlib.PurePath(file).parts
    return parts[2] if parts[0] == "include" else parts[1]


def mutants_of(root, file):
    text = (root / file).read_text()
    start, within_macro = 0, False
    for number, line in enumerate(text.splitlines(), 1):
        code = code_of(line)
        if not within_macro and not SKIPPED.search(code):
            for pattern, kind, switch in RULES:
                for match in pattern.finditer(text, start, start + len(code)):
                    if code[match.start() - start:match.end() - start] != match.group():
                        continue  # within a string
                    replaced = switch(text, match)
                    if replaced is not None:
                        yield Mutant(file, number, kind, line.strip(), *replaced)
        within_macro = line.endswith("\\")
        start += len(line) + 1


def sample(root, count, seed):
    """One mutant of each of so many lines, from all lines that have one. Depends on the seed and the sources alone."""
    lines = {}
    for file in library_files(root):
        for mutant in mutants_of(root, file):
            lines.setdefault((file, mutant.line), []).append(mutant)
    chosen = random.Random(seed)
    keys = sorted(lines)
    chosen.shuffle(keys)
    result, taken = [], {}
    for key in keys:
        mutant = chosen.choice(lines[key])
        spans = taken.setdefault(mutant.file, [])
        if any(mutant.begin < end and begin < mutant.end for begin, end in spans):
            continue  # operands of several lines, of which another is in the sample
        spans.append((mutant.begin, mutant.end))
        result.append(mutant)
        if len(result) == count:
            break
    for number, mutant in enumerate(result, 1):
        mutant.number = number
    return result


def switched_text(root, text, mutants):
    """A file with the switches of these mutants; the comment of its first line makes room for their header."""
    for mutant in sorted(mutants, key=lambda mutant: -mutant.begin):
        text = text[:mutant.begin] + mutant.switched.replace("%d", str(mutant.number)) + text[mutant.end:]
    first, rest = text.split("\n", 1)
    assert first.startswith("// SPDX"), first
    return f'#include "{root}/tests/mutation/switches.h"\n{rest}'
