# SPDX-License-Identifier: Apache-2.0
"""gather.py FOLDER: copies the repository's pages there, with what they link to, laid out as here. Sources become pages that show them; folders, pages that list
them."""

import pathlib
import re
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
LINK = re.compile(r'(\]\(|<img\s+src=")([^)\s"]+)')
LANGUAGES = {".cpp": "cpp", ".hpp": "cpp", ".h": "c", ".c": "c", ".py": "python", ".sh": "bash"}
CODE = re.compile(r"(^```.*?^```$)", re.MULTILINE | re.DOTALL)
PYTHON_REFERENCE = "# The Python package\n\n[Python](../docs/python.md) tells how to use it.\n\n::: geoloc\n    options:\n      members: true\n"


def tracked(pattern):
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", pattern], cwd=SOURCE, capture_output=True, text=True, check=True)
    return [pathlib.Path(line) for line in listed.stdout.splitlines()]


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def shown(path):
    """A source, or a folder, as a page."""
    whole = SOURCE / path
    if whole.is_dir():
        files = [file.relative_to(path) for file in tracked(f"{path}/*") if file.parent == path]
        return f"# {path}\n\n" + "".join(f"- [{file}]({page_of(path / file).name})\n" for file in files)
    return f"# {path.name}\n\n```{LANGUAGES[path.suffix]}\n{whole.read_text().rstrip()}\n```\n"


def page_of(path):
    """The page that stands for a path: itself, where it is no source and no folder."""
    if (SOURCE / path).is_dir():
        return path / "index.md"
    return path.with_name(path.name + ".md") if path.suffix in LANGUAGES else path


def main(folder):
    folder = pathlib.Path(folder)
    todo, done = tracked("*.md"), set()

    def lead(link, page):
        """The link as it is there, and its target among what is to be gathered."""
        target, hash_mark, fragment = link.partition("#")
        if not target or re.match(r"\w+:", target):
            return link
        path = (SOURCE / page).parent.joinpath(target).resolve().relative_to(SOURCE)
        todo.append(path)
        stands_for = page_of(path)
        return str(pathlib.PurePosixPath(target).parent / stands_for.name if stands_for != path and not (SOURCE / path).is_dir()
                   else pathlib.PurePosixPath(target) / "index.md" if stands_for != path else target) + hash_mark + fragment

    while todo:
        path = todo.pop()
        if path in done:
            continue
        done.add(path)
        if path.suffix == ".md":
            parts = CODE.split((SOURCE / path).read_text())
            parts[::2] = [LINK.sub(lambda found: found[1] + lead(found[2], path), text) for text in parts[::2]]  # noqa: B023
            write(folder / path, "".join(parts))
        elif page_of(path) != path:
            write(folder / page_of(path), shown(path))
            if (SOURCE / path).is_dir():
                todo += [file for file in tracked(f"{path}/*") if file.parent == path]
        else:
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / path).write_bytes((SOURCE / path).read_bytes())
    write(folder / "api/python.md", PYTHON_REFERENCE)


if __name__ == "__main__":
    main(sys.argv[1])
