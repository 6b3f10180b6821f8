# SPDX-License-Identifier: Apache-2.0
"""A program's help as completions for bash, zsh and fish."""

import re

FOLDERS = {"DIR", "RECORDING"}


def quoted(text):
    return "'" + text.replace("'", "'\\''") + "'"


def alternatives(option):
    """The words that the value may be; FILE and the like are none."""
    return option.choices or tuple(word for word in option.value.split("|") if word.islower())


def is_path(option):
    return bool(re.search(r"\b(FILE|DIR|RECORDING|INPUT|TEXT)\b", option.value))


# ---- bash ----

def bash_reply(option):
    """What sets COMPREPLY to what may follow the option."""
    kinds = ["-d"] if option.value in FOLDERS else ["-f"] if is_path(option) else []
    if words := alternatives(option):
        kinds.append(f"-W {quoted(' '.join(words))}")
    return f'mapfile -t COMPREPLY < <(compgen {" ".join(kinds)} -- "$word")' if kinds else "COMPREPLY=()"


def bash_cases(parsed):
    """The lines of `case $before in` … `esac`, if any option has a value."""
    with_value = [option for option in parsed.options() if option.value]
    cases = [f"    {'|'.join(option.names)}) {bash_reply(option)}; return ;;" for option in with_value]
    return ["  case $before in", *cases, "  esac"] if cases else []


def bash_function(parsed, function):
    words = [name for option in parsed.options() for name in option.names if name.startswith("--")]
    lines = [f"{function}() {{", '  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}']
    for name in parsed.commands:
        lines.append(f"  if [ \"$COMP_CWORD\" -gt 1 ] && [ \"${{COMP_WORDS[1]}}\" = {name} ]; then {function}_{name}; return; fi")
    lines += bash_cases(parsed)
    options = f'mapfile -t COMPREPLY < <(compgen -W {quoted(" ".join(words))} -- "$word")'
    if parsed.commands:
        lines.append(f'  mapfile -t COMPREPLY < <(compgen -W {quoted(" ".join([*parsed.commands, *words]))} -- "$word")')
    else:
        lines += [f'  if [[ $word == -* ]]; then {options}; else mapfile -t COMPREPLY < <(compgen -f -- "$word"); fi']
    return [*lines, "}"]


def bash(parsed):
    function = f"_{parsed.name}"
    lines = [f"# Completion of {parsed.name} in bash; made from its --help."]
    for name, command in parsed.commands.items():
        lines += bash_function(command, f"{function}_{name}")
    lines += [*bash_function(parsed, function), f"complete -o filenames -F {function} {parsed.name}"]
    return "\n".join(lines) + "\n"


# ---- zsh ----

def zsh_action(option):
    if words := alternatives(option):
        return f"({' '.join(words)})" if not is_path(option) else f"_alternative \"words:word:({' '.join(words)})\" \"files:file:_files\""
    if option.value in FOLDERS:
        return "_files -/"
    return "_files" if is_path(option) else " "


def zsh_option(option, name):
    text = re.sub(r"([\[\]:])", r"\\\1", option.text)
    value = f":{re.sub(r':', '', option.value)}:{zsh_action(option)}" if option.value else ""
    repeats = "*" if option.value.endswith("...") else ""
    return f"    {quoted(f'{repeats}{name}[{text}]{value}')}"


def zsh_arguments(parsed):
    lines = ["  _arguments -S \\"]
    lines += [f"{zsh_option(option, name)} \\" for option in parsed.options() for name in option.names]
    return lines


def zsh(parsed):
    lines = [f"#compdef {parsed.name}", f"# Completion of {parsed.name} in zsh; made from its --help."]
    if not parsed.commands:
        return "\n".join([*lines, *zsh_arguments(parsed), "    '*:file:_files'"]) + "\n"
    lines += ["if (( CURRENT > 2 )); then", "  local chosen=$words[2]", "  shift words", "  (( CURRENT-- ))", "  case $chosen in"]
    for name, command in parsed.commands.items():
        lines += [f"  {name})", *zsh_arguments(command), "    '*:file:_files'", "  ;;"]
    described = " ".join(quoted(f"{name}:{command.summary}") for name, command in parsed.commands.items())
    lines += ["  esac", "else", f"  local -a known=({described})", "  _describe command known", *zsh_arguments(parsed), "    '*: :'", "fi"]
    return "\n".join(lines) + "\n"


# ---- fish ----

def fish_option(program, option, condition):
    parts = [f"complete -c {program}", condition]
    for name in option.names:
        parts.append(f"-l {name[2:]}" if name.startswith("--") else f"-s {name[1:]}")
    if option.value:
        words = alternatives(option)
        parts.append("-r" if is_path(option) else "-x")
        if words:
            parts.append(f"-a '{' '.join(words)}'")
    parts.append("-d '" + option.text.replace("\\", "\\\\").replace("'", "\\'") + "'")
    return " ".join(part for part in parts if part)


def fish(parsed):
    lines = [f"# Completion of {parsed.name} in fish; made from its --help."]
    alone = "-n '__fish_use_subcommand'" if parsed.commands else ""
    lines += [fish_option(parsed.name, option, alone) for option in parsed.options()]
    for name, command in parsed.commands.items():
        lines.append(f"complete -c {parsed.name} -f -n '__fish_use_subcommand' -a {name} -d '{command.summary}'")
        lines += [fish_option(parsed.name, option, f"-n '__fish_seen_subcommand_from {name}'") for option in command.options()]
    return "\n".join(lines) + "\n"
