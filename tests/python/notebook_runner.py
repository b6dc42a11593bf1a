# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the code of a notebook as Jupyter does, without Jupyter."""

import ast
import contextlib
import io
import json
import os
from dataclasses import dataclass, field


@dataclass
class Run:
    """What a notebook left."""

    names: dict = field(default_factory=dict)
    printed: str = ""
    shown: list = field(default_factory=list)  #: per cell that ends in a value: its HTML, else its text


def code_cells(path):
    notebook = json.loads(path.read_text(encoding="utf-8"))
    return [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]


def run_notebook(path):
    """Runs all code cells in one namespace, in the folder of the notebook. What a cell's last line gives is shown."""
    run = Run(names={"__name__": "__main__"})
    output = io.StringIO()
    before = os.getcwd()
    os.chdir(path.parent)
    try:
        with contextlib.redirect_stdout(output):
            for number, cell in enumerate(code_cells(path), 1):
                value = run_cell("".join(cell["source"]), f"{path.name}, cell {number}", run.names)
                if value is not None:
                    run.shown.append(value._repr_html_() if hasattr(value, "_repr_html_") else repr(value))
    finally:
        os.chdir(before)
    run.printed = output.getvalue()
    return run


def run_cell(source, name, names):
    """Runs one cell, and returns the value of its last line if that is an expression."""
    tree = ast.parse(source, name)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, name, "exec"), names)
    return eval(compile(ast.Expression(last.value), name, "eval"), names) if last else None
