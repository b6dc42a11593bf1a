# SPDX-License-Identifier: GPL-3.0-or-later
"""Executes notebooks in Jupyter's kernel and looks at what they show: execute.py OUT NOTEBOOK...

The executed notebooks are written to the folder OUT.
"""

import pathlib
import sys

import nbclient
import nbformat


def check(notebook):
    """Fails unless no cell shows an error and the last one shows a page."""
    shown = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    errors = [output for output in shown if output.output_type == "error" or output.get("name") == "stderr"]
    if errors:
        sys.exit(f"a cell shows an error: {errors[0]}")
    html = notebook.cells[-1].outputs[-1].get("data", {}).get("text/html", "")
    if not html.startswith("<iframe srcdoc="):
        sys.exit("the last cell shows no page")


def main():
    out = pathlib.Path(sys.argv[1])
    out.mkdir(parents=True, exist_ok=True)
    for path in map(pathlib.Path, sys.argv[2:]):
        notebook = nbformat.read(path, as_version=4)
        nbclient.NotebookClient(notebook, resources={"metadata": {"path": str(path.parent)}}, timeout=120).execute()
        check(notebook)
        nbformat.write(notebook, out / path.name)
        print(f"{path.name}: {sum(cell.cell_type == 'code' for cell in notebook.cells)} cells, a page")


main()
