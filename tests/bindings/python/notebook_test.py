# SPDX-License-Identifier: Apache-2.0
"""Runs the code cells of a notebook without Jupyter: notebook_test.py NOTEBOOK LIGHT-FIELD FOLDER.

The light field takes the place of demo/portrait. The figures are written to FOLDER.
"""
import json
import os
import sys
from pathlib import Path

import matplotlib.pyplot as plt


def main() -> None:
    """Runs the notebook. Raises the exception of a cell, or AssertionError if the notebook or a figure is wrong."""
    notebook, light_field, work = (Path(argument).resolve() for argument in sys.argv[1:4])
    content = json.loads(notebook.read_text(encoding="utf-8"))
    assert content["nbformat"] == 4 and content["nbformat_minor"] == 5
    cells = content["cells"]
    assert len({cell["id"] for cell in cells}) == len(cells)
    (work / "demo").mkdir(parents=True)
    (work / "demo/portrait").symlink_to(light_field)
    (work / "examples/python").mkdir(parents=True)
    os.chdir(work / "examples/python")  # Jupyter runs a notebook in the folder of the notebook
    names: dict = {"__name__": "__main__"}
    code = [cell for cell in cells if cell["cell_type"] == "code"]
    for cell in code:
        assert not cell["outputs"] and cell["execution_count"] is None, f"cell {cell['id']} has outputs"
        exec(compile("".join(cell["source"]), f"cell {cell['id']}", "exec"), names)
    for number in plt.get_fignums():
        path = work / f"figure{number}.png"
        plt.figure(number).savefig(path)
        assert path.stat().st_size > 20000, f"{path} is empty"
    print(f"{len(code)} cells, {len(plt.get_fignums())} figures")


if __name__ == "__main__":
    main()
