#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that the C++ of all Markdown pages is compiled: each block must stand in snippets.cpp or in an example.

Indentation does not count. Lines of #include may stand anywhere in the file.
Usage: check_snippets.py REPOSITORY
"""
import pathlib
import re
import sys


def lines_of(text):
    return [line.strip() for line in text.splitlines() if line.strip()]


def blocks_of(page):
    text = page.read_text(encoding="utf-8")
    found = re.finditer(r"```(?:cpp|c\+\+|C\+\+)\n(.*?)```", text, re.S)
    return [(text.count("\n", 0, block.start()) + 1, block.group(1)) for block in found]


def stands_in(block, source):
    includes = [line for line in block if line.startswith("#include")]
    code = [line for line in block if not line.startswith("#include")]
    starts = range(len(source) - len(code) + 1)
    return all(line in source for line in includes) and any(source[i : i + len(code)] == code for i in starts)


def missing_blocks(pages, sources):
    """Blocks of pages that stand in none of the sources: (page, line)."""
    texts = [lines_of(source.read_text(encoding="utf-8")) for source in sources]
    blocks = [(page, line, lines_of(text)) for page in pages for line, text in blocks_of(page)]
    if not blocks:
        sys.exit("no C++ found in Markdown pages")
    return [(page, line) for page, line, block in blocks if not any(stands_in(block, text) for text in texts)]


def main():
    repository = pathlib.Path(sys.argv[1])
    folders = ["docs", "experiments", "data", "python", "web"]
    below = [page for folder in folders for page in sorted((repository / folder).rglob("*.md"))]
    pages = [*sorted(repository.glob("*.md")), *(page for page in below if "node_modules" not in page.parts)]
    sources = [repository / "tests/docs/snippets.cpp", *sorted((repository / "examples").glob("*.cpp"))]
    missing = missing_blocks(pages, sources)
    for page, line in missing:
        print(f"{page.relative_to(repository)}:{line}: this C++ is neither in tests/docs/snippets.cpp nor in an example")
    sys.exit(1 if missing else 0)


main()
