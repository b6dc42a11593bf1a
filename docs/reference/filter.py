#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Turns headers and Markdown into what Doxygen reads in their place: filter.py FOLDER FILE... writes FOLDER/FILE.

Headers: what a file declares is put into the module of its folder. Explicit instantiations are left out.
Markdown: pages and headings get names, and relative links lead to the pages of the site.
Run from the root of the repository, with paths relative to it. Lines keep their numbers.
"""
import pathlib
import posixpath
import re
import sys

# Stands for a bar in code that is in a table, until the site is built.
BAR = "\ue000"
FRONT_DOOR = "front_door"
# Pages with more headings than this begin with a list of them.
LONG_PAGE = 4
# Folders whose Markdown pages are part of the site, and single pages beside them.
PAGE_FOLDERS = ("docs/", "experiments/")
PAGES = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "data/README.md", "web/README.md")


def module_of(path):
    """The module of a header or of a folder of headers: `io_motion` for include/lodestone/io/motion/motion.h."""
    folder = path.removeprefix("include/lodestone")
    folder = posixpath.dirname(folder) if folder.endswith(".h") else folder
    return folder.strip("/").replace("/", "_") or FRONT_DOOR


def page_of(path):
    """The name of the page of a Markdown file: `decisions_0001_dependencies`."""
    name = path.removeprefix("docs/").removesuffix(".md").removesuffix("/README")
    name = re.sub(r"\W", "_", name).lower()
    # concepts.html is Doxygen's own list of C++ concepts.
    return {"readme": "mainpage", "concepts": "concept_pages"}.get(name, name)


def is_page(path):
    return path in PAGES or (path.endswith(".md") and path.startswith(PAGE_FOLDERS))


def slug(heading):
    """The anchor that git hosts give a heading."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    return re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", "-")


def slugs(headings):
    """The anchors of the headings of a page, in order; equal ones are numbered."""
    seen, anchors = {}, []
    for heading in headings:
        anchor = slug(heading)
        count = seen.get(anchor, 0)
        seen[anchor] = count + 1
        anchors.append(f"{anchor}-{count}" if count else anchor)
    return anchors


def escaped(name):
    """A file's name as Doxygen writes it into the names of its pages."""
    return name.replace("_", "__").replace(".", "_8").replace("/", "_2")


def target_of(path, anchor):
    """Where a link to a file or folder of the repository leads in the site; None: nowhere."""
    if is_page(path):
        page = page_of(path)
        return ("index" if page == "mainpage" else page) + ".html" + (f"#{page}_{anchor}" if anchor else "")
    if path.startswith("include/") and path.endswith(".h"):
        return escaped(posixpath.basename(path)) + "_source.html"
    if path.startswith("include/lodestone"):
        return "group__" + escaped(module_of(path)) + ".html"
    if path.startswith("examples/") and path.endswith(".cpp"):
        return posixpath.basename(path).replace(".", "_8") + "-example.html"
    if path.endswith((".png", ".svg", ".json")):
        return path
    return None


def without_autolinks(text):
    """Keeps a word that begins a sentence from becoming a link to the type of that name: Particles, Frame."""
    return re.sub(r"(^|[.:;?!|>] +|\*\*)([A-Z][a-z]+)(?=,? [a-z`*])", r"\1%\2", text)


class Names:
    """The types and concepts that headers declare, and their pages."""

    def __init__(self, headers):
        self.pages, self.concepts = {}, set()
        for text in headers:
            declared = r"^(class|struct|concept) (?:alignas\(\d+\) )?(\w+)(?: final)?(?: [:={]|$)"
            for kind, name in re.findall(declared, text, re.M):
                self.pages[name] = f"{kind}lodestone_1_1{escaped(name)}.html"
                if kind == "concept":
                    self.concepts.add(name)

    def linked_code(self, code):
        """Code in backticks; the name of a type, or of one of its members, becomes a link."""
        page = self.pages.get(code.strip("`").partition("::")[0])
        return f"[{code}]({page})" if page and re.fullmatch(r"`\w\w+(::\w+)*`", code) else code

    def with_linked_concepts(self, text):
        """Links concepts in prose, which Doxygen does not."""

        def link(match):
            name = match[0]
            return f"[{name}]({self.pages[name]})" if name in self.concepts else name

        return re.sub(r"(?<![`\w:])[A-Z][a-z]+_\w+(?![`\w])", link, text)


def with_marked_code(text):
    """Lets Doxygen link names of types, and of their members, that stand in backticks of a header."""
    return re.sub(r"(?<!`)`([A-Z]\w+(?:::\w+)*)`(?!`)", r"<code>\1</code>", text)


def cited(match):
    """A link to an entry of the bibliography: Saenghaengtham 2006."""
    key = match[1]
    words = re.sub(r"(\d{4})$", r" \1", key.replace("_", " "))
    return f'\\ref {key} "{words[0].upper() + words[1:]}"'


def filter_header(path, text, names):
    lines = text.split("\n")
    begin = lines.index("namespace lodestone {")
    # What stands before the namespace introduces the file.
    first = begin
    while lines[first - 1].startswith("///"):
        first -= 1
    lines[first - 1] = "/// @file"
    lines[begin] += f" /** @addtogroup {module_of(path)} */ /** @{{ */"
    end = max(i for i, line in enumerate(lines) if line.startswith("}  // namespace lodestone"))
    lines[end] = "/** @} */ " + lines[end]
    inside = False
    for i, line in enumerate(lines):
        if inside or line.startswith("extern template"):
            inside = not line.rstrip().endswith(";")
            lines[i] = ""
            continue
        comment = re.match(r"(.*///<? ?)(.*)", line)
        if not comment:
            continue
        code, words = comment.groups()
        words = re.sub(r"\\cite (\w+)", cited, words)
        before = lines[i - 1].strip()
        starts = "///<" in code or not before.startswith("///") or before.endswith((".", ":")) or before == "///"
        words = without_autolinks(words) if starts else without_autolinks("\0" + words)[1:]
        lines[i] = code + with_marked_code(names.with_linked_concepts(words))
    return "\n".join(lines)


def filter_prose(line, path, names):
    """A line of Markdown that is no code and no heading."""
    folder = posixpath.dirname(path)
    kept = []

    def keep(text):
        kept.append(text)
        return f"\1{len(kept) - 1}\1"

    def href(link):
        link, _, anchor = link.partition("#")
        file = posixpath.normpath(posixpath.join(folder, link)) if link else path
        return target_of(file, anchor)

    def image(match):
        return keep(f'<img src="{href(match[2])}" alt="{match[1]}"/>')

    def code(match):
        # Doxygen takes `a'b'` for a quotation, but not what two backticks enclose; and has no bar for code in a cell.
        words = match[1]
        if r"\|" in words:
            return keep("`" + words.replace(r"\|", BAR) + "`")
        if "'" in words:
            return keep(f"``{words}``")
        return keep(names.linked_code(match[0]))

    def link(match):
        text, goal = match[1], match[2]
        if re.match(r"https?:", goal):
            return keep(match[0])
        goal = href(goal)
        return keep(f"[{text}]({goal})" if goal else text)

    line = re.sub(r"!\[([^\]]*)\]\(([^)]*)\)", image, line)
    line = re.sub(r"\[((?:`[^`]*`|[^\]`])*)\]\(([^)]*)\)", link, line)
    line = re.sub(r"(?<!`)`([^`]*)`(?!`)", code, line)
    line = re.sub(r"--", "&ndash;", without_autolinks(line)) if "|" not in line else line
    while "\1" in line:
        line = re.sub("\1(\\d+)\1", lambda m: kept[int(m[1])], line)
    return line


def filter_page(path, text, names):
    page = page_of(path)
    lines = text.split("\n")
    headings = [line.lstrip("# ") for line in without_code(text).split("\n") if re.match(r"#+ ", line)]
    anchors = iter(slugs(headings))
    if len(headings) > LONG_PAGE and lines[1] == "":
        lines[1] = "[TOC]"
    chunks, prose, code = [], [], False

    def flush():
        if prose:
            chunks.append(filter_prose("\n".join(prose), path, names))
            prose.clear()

    for number, line in enumerate(lines):
        fence = line.strip().startswith("```")
        if fence or code:
            flush()
            code = code != fence
            chunks.append(re.sub(r"```$", "```{.unparsed}", line) if fence and code else line)
        elif re.match(r"#+ ", line):
            flush()
            anchor = next(anchors)
            title = re.sub(r"`", "", line)
            chunks.append(f"{title} {{#{page}}}" if number == 0 else f"{title} {{#{page}_{anchor}}}")
        elif not line:
            flush()
            chunks.append(line)
        else:
            prose.append(line)
    flush()
    result = "\n".join(chunks)
    if page == "bibliography":
        result = re.sub(r"^- `(\w+)`:", r"- \\anchor \1 `\1`:", result, flags=re.M)
    return result


def without_code(text):
    """The text with the lines of fenced code blocks empty."""
    code, lines = False, []
    for line in text.split("\n"):
        fence = line.strip().startswith("```")
        lines.append("" if fence or code else line)
        code = code != fence
    return "\n".join(lines)


def main():
    folder, *paths = sys.argv[1:]
    texts = {path: pathlib.Path(path).read_text(encoding="utf-8") for path in paths}
    names = Names(text for path, text in texts.items() if path.endswith(".h"))
    for path, text in texts.items():
        seen = filter_header(path, text, names) if path.endswith(".h") else filter_page(path, text, names)
        file = pathlib.Path(folder, path)
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(seen, encoding="utf-8")


if __name__ == "__main__":
    main()
