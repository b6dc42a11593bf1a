#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks links: those between the repository's Markdown files, and those of a built site if one is given.

A relative link must lead to a file or folder, and its anchor to a heading or an element of that name. Links to other
hosts are not followed.
Usage: check_links.py REPOSITORY [SITE]
"""
import html.parser
import pathlib
import re
import sys
import urllib.parse

# Folders of what is built or installed.
NO_SOURCE = {"build", "out", "node_modules", ".git"}
OTHER = re.compile(r"[a-z][a-z0-9+.-]*:|//", re.I)


def without_code(text):
    """The text without its code, line by line as before."""
    lines, code = [], False
    for line in text.splitlines():
        fence = line.strip().startswith("```")
        lines.append("" if fence or code else line)
        code = code != fence
    return re.sub(r"`[^`]*`", lambda span: "\n" * span[0].count("\n"), "\n".join(lines))


def anchors_of(text):
    """Anchors of the headings of a Markdown file, as git hosts name them: equal ones are numbered."""
    code, seen, anchors = False, {}, set()
    for line in text.splitlines():
        fence = line.strip().startswith("```")
        code = code != fence
        heading = re.match(r"#+ +(.*)", line)
        if code or not heading:
            continue
        words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading[1].strip().lower())
        anchor = re.sub(r"[^\w\- ]", "", words).replace(" ", "-")
        count = seen.get(anchor, 0)
        seen[anchor] = count + 1
        anchors.add(f"{anchor}-{count}" if count else anchor)
    return anchors


def check_markdown(repository):
    found = sorted(page.relative_to(repository) for page in repository.rglob("*.md"))
    listed = [page for page in found if not NO_SOURCE & set(page.parts)]
    pages = {page: (repository / page).read_text(encoding="utf-8") for page in listed}
    anchors = {(repository / page).resolve(): anchors_of(text) for page, text in pages.items()}
    count = 0
    for page, text in pages.items():
        prose = without_code(text)
        for link in re.finditer(r"\]\(\s*([^)\s]+)\s*\)", prose):
            if OTHER.match(link[1]):
                continue
            count += 1
            path, _, anchor = link[1].partition("#")
            file = (repository / page).resolve()
            if path:
                file = (file.parent / urllib.parse.unquote(path)).resolve()
            line = prose.count("\n", 0, link.start()) + 1
            if not file.exists():
                yield f"{page}:{line}: no such file: {link[1]}"
            elif anchor and file in anchors and anchor not in anchors[file]:
                yield f"{page}:{line}: no such heading: {link[1]}"
    if count == 0:
        yield "no links found in Markdown files"


class Page(html.parser.HTMLParser):
    """Names of the elements of a page, and what it links to."""

    def __init__(self, file):
        super().__init__()
        self.names, self.links = set(), []
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        for key, value in attributes:
            if key == "id" or (key == "name" and tag == "a"):
                self.names.add(value)
            elif key in ("href", "src") and value:
                self.links.append((self.getpos()[0], value))


def check_site(site):
    pages = {file.resolve(): Page(file) for file in site.rglob("*.html")}
    if site.resolve() / "index.html" not in pages:
        yield f"{site} has no index.html"
    for file, page in sorted(pages.items()):
        for line, link in page.links:
            if OTHER.match(link):
                continue
            path, _, anchor = link.partition("#")
            target = (file.parent / urllib.parse.unquote(path.partition("?")[0])).resolve() if path else file
            if not target.is_file():
                yield f"{file}:{line}: no such file: {link}"
            elif anchor and target in pages and urllib.parse.unquote(anchor) not in pages[target].names:
                yield f"{file}:{line}: no such anchor: {link}"


def check_menus(site):
    """Links that scripts write: those of menus and of the search."""
    names = {file.resolve(): Page(file).names for file in site.rglob("*.html")}
    for file in sorted(site.rglob("*.js")):
        links = re.findall(r"""["']((?:\.\./)*[\w.-]+\.html(?:#[\w-]*)?)["']""", file.read_text(encoding="utf-8"))
        for link in sorted(set(links)):
            path, _, anchor = link.partition("#")
            targets = [(folder / path).resolve() for folder in (file.parent, site)]
            target = next((target for target in targets if target in names), None)
            if target is None or (anchor and anchor not in names[target]):
                yield f"{file}: leads nowhere: {link}"


def main():
    errors = list(check_markdown(pathlib.Path(sys.argv[1])))
    if len(sys.argv) > 2:
        site = pathlib.Path(sys.argv[2])
        errors += [*check_site(site), *check_menus(site)]
    for error in errors:
        print(error)
    sys.exit(1 if errors else 0)


main()
