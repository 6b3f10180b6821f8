# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
import subprocess
import unittest

from support import AppTest, open_terminal

PACKAGES = pathlib.Path(os.environ["GEOLOC_SOURCE_DIR"]) / "scripts/packages.sh"

# A stand-in for apt-get whose first package takes a while.
APT_GET = """#!/bin/sh
case "$*" in
  *--assume-no*) echo "0 upgraded, 2 newly installed, 0 to remove."; echo "Need to get 3 MB of archives."
                 echo "After this operation, 7 MB of additional disk space will be used."; exit 1 ;;
  *install*) {install} ;;
esac
"""
INSTALLS_SLOWLY = "sleep 2.5; echo 'Get:1 first'; echo 'Unpacking first'; echo 'Setting up first'; sleep 1.2"


class Installation(AppTest):
    """Packages are installed with progress on the terminal, however long nothing happens at first."""

    def install(self, apt_get):
        """The exit status, and what the terminal showed."""
        tools = self.folder / "tools"
        tools.mkdir()
        (self.folder / "build").mkdir()
        for name, text in {"apt-get": APT_GET.format(install=apt_get), "dpkg-query": "#!/bin/sh\nexit 1\n",
                           "sudo": '#!/bin/sh\nexec "$@"\n'}.items():
            (tools / name).write_text(text)
            (tools / name).chmod(0o755)
        terminal, its_end = open_terminal()
        with subprocess.Popen(["bash", "-c", f"set -euo pipefail; source {PACKAGES}; install_packages one two; say installed"],
                              env={**os.environ, "ROOT": str(self.folder), "PATH": f"{tools}:{os.environ['PATH']}"},
                              stderr=its_end) as script:
            os.close(its_end)
            shown = b""
            try:
                while part := os.read(terminal, 4096):
                    shown += part
            except OSError:  # Linux's word for the end of a terminal
                pass
            status = script.wait(timeout=60)
        os.close(terminal)
        return status, shown.decode()

    def test_nothing_is_set_up_in_the_first_seconds(self):
        status, shown = self.install(INSTALLS_SLOWLY)
        self.assertEqual(status, 0, shown)
        for expected in ("2 with what they need: 3 MB of download, 7 MB on disk",
                         "fetched 0, unpacked 0, set up 0 of 2 packages", "fetched 1, unpacked 1, set up 1 of 2 packages",
                         "== installed"):
            self.assertIn(expected, shown)

    def test_a_failure_is_shown_with_its_reason(self):
        status, shown = self.install("sleep 1.2; echo 'E: no space left'; exit 100")
        self.assertEqual(status, 1, shown)
        self.assertIn("E: no space left", shown)
        self.assertNotIn("== installed", shown)


if __name__ == "__main__":
    unittest.main()
