#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""scripts/tidy.py BUILD [FILE.cpp…]: clang-tidy on the files given, or on all that BUILD compiles.

Most of its time goes into headers, so the files of a target are read as one, and their headers once. Files that
cannot be read as one, because two of them define the same name, are read one by one.
"""
import collections
import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

FILES_AT_ONCE = 12


def compiled_files(build):
    """{file: (the target it belongs to, its compiler's arguments without the file's names)}"""
    commands = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        arguments = shlex.split(entry["command"])
        output = arguments[arguments.index("-o") + 1]
        for option in "-o", "-c":
            del arguments[arguments.index(option):arguments.index(option) + 2]
        commands.setdefault(pathlib.Path(entry["file"]), (output.split(".dir/")[0], arguments))
    return commands


def batches(commands):
    """Lists of files of the same target."""
    targets = collections.defaultdict(list)
    for file in sorted(commands):
        targets[commands[file][0]].append(file)
    for files in targets.values():
        for begin in range(0, len(files), FILES_AT_ONCE):
            yield files[begin:begin + FILES_AT_ONCE]


def write_units(folder, commands, groups):
    """Writes one source per group, which includes its files, into a folder with its own compile_commands.json. Returns the
    sources."""
    folder.mkdir(exist_ok=True)
    entries = [(file, arguments) for file, (_, arguments) in commands.items()]
    units = []
    for number, files in enumerate(groups):
        unit = folder / f"unit_{number}.cpp" if len(files) > 1 else files[0]
        if len(files) > 1:
            unit.write_text("".join(f'#include "{file}"\n' for file in files))
            # An alias may hide that of another file, which is no fault if each file is read alone.
            entries.append((unit, [*commands[files[0]][1], "-Wno-shadow"]))
        units.append(unit)
    (folder / "compile_commands.json").write_text(json.dumps(
        [{"directory": str(folder), "file": str(file), "arguments": [*arguments, "-c", str(file)]}
         for file, arguments in entries]))
    return units


def tidy(folder, source):
    """The findings of clang-tidy, or an empty text; and whether it failed to compile the source."""
    done = subprocess.run(["clang-tidy", "-p", folder, "--quiet", source], capture_output=True, text=True, check=False)
    found = "" if done.returncode == 0 else done.stdout or done.stderr or f"clang-tidy failed on {source}\n"
    return found, "[clang-diagnostic-error]" in found


def check(folder, unit, files):
    found, broken = tidy(folder, unit)
    if broken and len(files) > 1:
        found = "".join(tidy(folder, file)[0] for file in files)
    return found


def main(build, *names):
    build = pathlib.Path(build).resolve()
    commands = compiled_files(build)
    chosen = [pathlib.Path(name).resolve() for name in names]
    unknown = [file for file in chosen if file not in commands]
    if unknown:
        sys.exit(f"{build} does not compile " + ", ".join(map(str, unknown)))
    groups = list(batches({file: commands[file] for file in chosen or commands}))
    folder = build / "_tidy"
    units = write_units(folder, commands, groups)
    told = set()  # a header's findings come up in every unit that includes it
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for found in pool.map(check, [folder] * len(units), units, groups):
            for finding in re.split(r"(?m)^(?=/\S+:\d+:\d+: (?:error|warning))", found):
                if finding.strip() and finding not in told:
                    told.add(finding)
                    print(finding, end="", flush=True)
    print(f"{sum(map(len, groups))} files, {len(told)} findings")
    return 1 if told else 0


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
