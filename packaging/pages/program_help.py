# SPDX-License-Identifier: Apache-2.0
"""What a program says of itself with --help (CLI11's layout), as values."""

import re
import subprocess
from dataclasses import dataclass, field, replace

COLUMN = 30  # where the texts of the options begin


@dataclass(frozen=True)
class Option:
    """An option, or a positional argument, whose names are then its one name without dashes."""

    names: tuple[str, ...]
    value: str = ""  # as the help writes it: FILE, [HOST:]PORT; "" of a flag
    choices: tuple[str, ...] = ()
    bounds: tuple[str, str] | None = None
    default: str = ""
    needs: tuple[str, ...] = ()
    excludes: tuple[str, ...] = ()
    is_required: bool = False
    text: str = ""


@dataclass
class Help:
    name: str
    summary: str
    usage: str
    positionals: list[Option] = field(default_factory=list)
    groups: dict[str, list[Option]] = field(default_factory=dict)  # by their title
    commands: dict[str, "Help"] = field(default_factory=dict)

    def options(self):
        return [option for group in self.groups.values() for option in group]


def option_of(head, text):
    """`head` is what stands in the column of names: "--speed X:FLOAT in [0 - 1000]=1 Needs: --http"."""
    names, _, spec = head.partition(" ")
    option = Option(tuple(names.split(",")), text=text)
    for word, name in (("Needs", "needs"), ("Excludes", "excludes")):
        if found := re.search(rf"(^| ){word}:((?: --[\w-]+)+)", spec):
            option = replace(option, **{name: tuple(sorted(found[2].split()))})  # CLI11 orders them by their addresses
            spec = spec[:found.start()] + spec[found.end():]
    if found := re.search(r"(^| )REQUIRED", spec):
        option = replace(option, is_required=True)
        spec = spec[:found.start()] + spec[found.end():]
    spec = re.sub(r" x \d+$", "", spec)
    value, of_type, rest = re.match(r"(.*?)(?:(:(?=FLOAT|U?INT|\{|value ))(.*))?$", spec).groups()
    if not of_type:
        value, _, default = value.partition("=")
        return replace(option, value=value, default=default)
    if found := re.match(r"(?:value in )?\{(.*?)\}", rest):
        option = replace(option, choices=tuple(choice.partition("->")[0] for choice in found[1].split(",")))
    elif found := re.match(r"\w+ in \[(\S+) - (\S+)\]", rest):
        option = replace(option, bounds=(found[1], found[2]))
    default = rest[found.end():].partition("=")[2] if found else ""
    return replace(option, value=value, default=default)


def entries(lines):
    """(head, text) of each entry of a section: the text stands beside a short head, and below one that is longer than the column."""
    below = " " * COLUMN
    found = []
    for line, following in zip(lines, [*lines[1:], ""]):
        if line.startswith(below):
            found[-1] = (found[-1][0], line.strip())
        elif following.startswith(below):
            found.append((line.strip(), ""))
        else:
            found.append((line[:COLUMN].strip(), line[COLUMN:].strip()))
    return found


def sections(text):
    """(title, lines) of what follows the usage."""
    title, lines = "", []
    for line in text.splitlines():
        if re.match(r"\S.*:$", line):
            yield title, lines
            title, lines = line[:-1], []
        elif line.strip():
            lines.append(line)
    yield title, lines


def parse(name, text):
    before, _, after = text.partition("Usage: ")
    usage, _, rest = after.partition("\n")
    parsed = Help(name, " ".join(before.split()), usage)
    for title, lines in sections(rest):
        if title == "Positionals":
            parsed.positionals = [option_of(*entry) for entry in entries(lines)]
        elif title == "Subcommands":
            parsed.commands = {head: Help(head, text, "") for head, text in entries(lines)}
        elif title:
            parsed.groups[title] = [option_of(*entry) for entry in entries(lines)]
    return parsed


def help_of(command, name):
    """Of the program that the command runs, and of its own commands."""
    def said(*arguments):
        return subprocess.run([*command, *arguments, "--help"], stdout=subprocess.PIPE, text=True, check=True).stdout

    parsed = parse(name, said())
    parsed.commands = {command: parse(command, said(command)) for command in parsed.commands}
    return parsed
