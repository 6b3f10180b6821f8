# SPDX-License-Identifier: Apache-2.0
"""readme_example.py README.md: README's program in Python runs as it stands, and prints what its comment says."""

import pathlib
import re
import subprocess
import sys

page = pathlib.Path(sys.argv[1]).read_text()
(program,) = re.findall(r"^```python\n(.*?)^```", page, re.MULTILINE | re.DOTALL)
(promised,) = re.findall(r"print\(.*\)  # ([\d.]+, [\d.]+)$", program, re.MULTILINE)
printed = subprocess.run([sys.executable, "-c", program], cwd="/", capture_output=True, text=True, check=True).stdout
if printed != promised + "\n":
    sys.exit(f"README.md says {promised}, but its program prints {printed}")
print(f"README.md's program prints {promised}")
