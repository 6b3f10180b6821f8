# SPDX-License-Identifier: Apache-2.0
"""A program's help as a page of the manual, in roff."""

import re

EXIT_STATUS = (("0", "Done. Ctrl-C ends a run, too, with all results written."), ("1", "Failed while running."),
               ("2", "Unusable arguments or input; nothing was written."))


def escaped(text):
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq").replace("~", "\\(ti").replace("^", "\\(ha")
    return "".join(c if c.isascii() else f"\\[u{ord(c):04X}]" for c in text)


def protected(line):
    """A line of text that roff does not take for a request."""
    return "\\&" + line if line.startswith((".", "\\(aq")) else line


def sentence(text):
    text = text.strip()
    return text if not text or text.endswith((".", "!", "?")) else text + "."


def details(option):
    """What the help writes beside an option's name, in words."""
    words = [sentence(option.text)]
    if option.choices:
        words.append("One of: " + ", ".join(option.choices) + ".")
    if option.bounds:
        words.append("From {} to {}.".format(*option.bounds))
    if option.default:
        words.append(f"Default: {option.default}.")
    if option.needs:
        words.append("Only with " + ", ".join(option.needs) + ".")
    if option.excludes:
        words.append("Not with " + ", ".join(option.excludes) + ".")
    if option.is_required:
        words.append("Required.")
    return " ".join(word for word in words if word)


def entry(option):
    names = ", ".join(f"\\fB{escaped(name)}\\fR" if name.startswith("-") else f"\\fI{escaped(name)}\\fR" for name in option.names)
    value = f" \\fI{escaped(option.value)}\\fR" if option.value and option.names[0].startswith("-") else ""
    return [".TP", names + value, protected(escaped(details(option)))]


def groups(parsed):
    lines = []
    for option in parsed.positionals:
        lines += entry(option)
    for title, options in parsed.groups.items():
        if title != "Options":
            lines.append(f'.SS "{escaped(title)}"')
        for option in options:
            lines += entry(option)
    return lines


def synopsis(parsed):
    lines = []
    for command in (parsed, *parsed.commands.values()) if not parsed.commands else parsed.commands.values():
        usage = re.sub(rf"^{re.escape(parsed.name)} ?", "", command.usage)
        lines += [".br"] * bool(lines) + [f".B {escaped(parsed.name)}", protected(escaped(usage))]
    return lines


def man_page(parsed, version, others):
    """The page's text; `others` are the programs that it refers to."""
    summary = parsed.summary.rstrip(".")
    lines = [
        '.\\" Made from the program\'s --help.',
        f'.TH "{parsed.name.upper()}" "1" "" "geoloc {version}" "User Commands"',
        ".SH NAME",
        escaped(f"{parsed.name} ") + "\\- " + escaped(summary[0].lower() + summary[1:]),
        ".SH SYNOPSIS", *synopsis(parsed),
        ".SH DESCRIPTION", protected(escaped(sentence(parsed.summary))),
        "The pages of /usr/share/doc/geoloc tell all about inputs, outputs, settings and the method.",
        ".SH OPTIONS", *groups(parsed),
    ]
    for name, command in parsed.commands.items():
        lines += [f'.SH "OPTIONS OF {escaped(name.upper())}"', protected(escaped(sentence(command.summary))), *groups(command)]
    lines.append(".SH EXIT STATUS")
    for status, meaning in EXIT_STATUS:
        lines += [".TP", status, meaning]
    others = [other for other in others if other != parsed.name]
    lines += [".SH SEE ALSO", *(f".BR {escaped(other)} (1)" + ("," if other != others[-1] else "") for other in others)]
    return "\n".join(lines) + "\n"
