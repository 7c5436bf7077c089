# SPDX-License-Identifier: Apache-2.0
"""Runs the Python code of documents: documents_test.py LIGHT-FIELD FOLDER DOCUMENT...

The light field takes the place of demo/portrait.
"""
import os
import re
import sys
from pathlib import Path


def main() -> None:
    """Runs each code block. Raises the exception of a block, or AssertionError if a document has no Python code."""
    light_field, work, *documents = (Path(argument).resolve() for argument in sys.argv[1:])
    (work / "demo").mkdir(parents=True)
    (work / "demo/portrait").symlink_to(light_field)
    os.chdir(work)
    for document in documents:
        blocks = re.findall(r"^```python\n(.*?)^```$", document.read_text(encoding="utf-8"), re.M | re.S)
        assert blocks, f"{document}: expected a block of Python, found none"
        for block in blocks:
            exec(compile(block, str(document), "exec"), {"__name__": "__main__"})
    print(f"{len(documents)} documents")


if __name__ == "__main__":
    main()
