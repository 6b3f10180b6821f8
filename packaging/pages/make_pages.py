#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Pages of the manual, and completions for bash, zsh and fish, from what the programs say with --help; in the folders below FOLDER that an
installed tree has below share."""

import argparse
import gzip
import pathlib

from completions import bash, fish, zsh
from man_page import man_page
from program_help import help_of


def write(path, content):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)


def main(version, folder, programs, emulator):
    names = [program.name for program in programs]
    for program, name in zip(programs, names):
        parsed = help_of([*emulator, program], name)
        page = man_page(parsed, version, names).encode()
        write(folder / f"man/man1/{name}.1.gz", gzip.compress(page, mtime=0))  # the same bytes whenever it is made
        write(folder / f"bash-completion/completions/{name}", bash(parsed).encode())
        write(folder / f"zsh/vendor-completions/_{name}", zsh(parsed).encode())
        write(folder / f"fish/vendor_completions.d/{name}.fish", fish(parsed).encode())


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("version")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("programs", nargs="+", type=pathlib.Path)
    parser.add_argument("--emulator", nargs="*", default=[], help="runs programs of another processor")
    arguments = parser.parse_args()
    main(arguments.version, arguments.folder, arguments.programs, arguments.emulator)
