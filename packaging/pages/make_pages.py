#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""make_pages.py VERSION FOLDER PROGRAM…: pages of the manual, and completions for bash, zsh and fish, from what the programs say with
--help; in the folders below FOLDER that an installed tree has below share."""

import gzip
import pathlib
import sys

from completions import bash, fish, zsh
from man_page import man_page
from program_help import help_of


def write(path, content):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)


def main(version, folder, *programs):
    folder = pathlib.Path(folder)
    names = [pathlib.Path(program).name for program in programs]
    for program, name in zip(programs, names):
        parsed = help_of(program, name)
        page = man_page(parsed, version, names).encode()
        write(folder / f"man/man1/{name}.1.gz", gzip.compress(page, mtime=0))  # the same bytes whenever it is made
        write(folder / f"bash-completion/completions/{name}", bash(parsed).encode())
        write(folder / f"zsh/vendor-completions/_{name}", zsh(parsed).encode())
        write(folder / f"fish/vendor_completions.d/{name}.fish", fish(parsed).encode())


if __name__ == "__main__":
    main(*sys.argv[1:])
