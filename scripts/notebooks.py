# SPDX-License-Identifier: Apache-2.0
"""notebooks.py FOLDER NOTEBOOK…: executes notebooks in the folder, saves them there with what they show, and their pictures beside them."""

import base64
import pathlib
import sys

import nbformat
from nbclient import NotebookClient


def main(folder, *notebooks):
    folder = pathlib.Path(folder)
    for path in map(pathlib.Path, notebooks):
        notebook = nbformat.read(path, as_version=4)
        NotebookClient(notebook, timeout=600, resources={"metadata": {"path": str(folder)}}).execute()
        nbformat.write(notebook, folder / path.name)
        print(f"== {path}")
        pictures = 0
        for output in (output for cell in notebook.cells for output in cell.get("outputs", [])):
            print(output.get("text", "").rstrip(), end="\n" if output.get("text") else "")
            if "image/png" in output.get("data", {}):
                pictures += 1
                (folder / f"{path.stem}_{pictures}.png").write_bytes(base64.b64decode(output["data"]["image/png"]))
        if not pictures:
            sys.exit(f"{path} shows no picture")


if __name__ == "__main__":
    main(*sys.argv[1:])
