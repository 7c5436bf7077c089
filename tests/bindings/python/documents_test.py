# SPDX-License-Identifier: Apache-2.0
"""Runs the Python code of documents and notebooks: documents_test.py LIGHT-FIELD FOLDER DOCUMENT...

The light field takes the place of demo/portrait. The figures of notebooks are written to FOLDER.
"""
import json
import os
import re
import sys
from pathlib import Path

import matplotlib.pyplot as plt


def blocks_of_notebook(document: Path) -> list[str]:
    """Returns the code cells. Raises AssertionError if the notebook is wrong or was saved with outputs."""
    content = json.loads(document.read_text(encoding="utf-8"))
    assert content["nbformat"] == 4 and content["nbformat_minor"] == 5
    assert len({cell["id"] for cell in content["cells"]}) == len(content["cells"])
    code = [cell for cell in content["cells"] if cell["cell_type"] == "code"]
    for cell in code:
        assert not cell["outputs"] and cell["execution_count"] is None, f"cell {cell['id']} has outputs"
    return ["".join(cell["source"]) for cell in code]


def main() -> None:
    """Runs each block of code. Raises the exception of a block, or AssertionError if a document or a figure is wrong."""
    light_field, work, *documents = (Path(argument).resolve() for argument in sys.argv[1:])
    for folder in ("demo", "examples/python"):
        (work / folder).mkdir(parents=True)
    (work / "demo/portrait").symlink_to(light_field)
    for document in documents:
        is_notebook = document.suffix == ".ipynb"
        blocks = blocks_of_notebook(document) if is_notebook else re.findall(
            r"^```python\n(.*?)^```$", document.read_text(encoding="utf-8"), re.M | re.S)
        assert blocks, f"{document}: expected a block of Python, found none"
        os.chdir(work / "examples/python" if is_notebook else work)  # Jupyter runs a notebook in the folder of the notebook
        names: dict = {"__name__": "__main__"}
        for number, block in enumerate(blocks):
            exec(compile(block, f"{document}, block {number}", "exec"), names if is_notebook else {"__name__": "__main__"})
    for number in plt.get_fignums():
        path = work / f"figure{number}.png"
        plt.figure(number).savefig(path)
        assert path.stat().st_size > 20000, f"{path} is empty"
    print(f"{len(documents)} documents, {len(plt.get_fignums())} figures")


if __name__ == "__main__":
    main()
