# SPDX-License-Identifier: Apache-2.0
import gzip
import re
import shutil
import subprocess
import unittest

from support import BIN, PROGRAMS, AppTest, run

SHARE = BIN.parent / "share"
COMMANDS = {"geoloc_import": ("stills", "video")}


def options_of(program):
    """Every long option that the program and its commands tell with --help."""
    texts = [run(program, *command, "--help").out for command in ((), *((name,) for name in COMMANDS.get(program, ())))]
    return sorted(set(re.findall(r"^  (?:-\w,)?(--[\w-]+)", "\n".join(texts), re.MULTILINE)))


@unittest.skipUnless((SHARE / "man").is_dir(), "was built without pages")
class ManualAndCompletions(AppTest):
    """The manual's pages and the shells' completions are made from --help, and have all that stands there."""

    def test_every_option_is_in_the_manual_and_in_each_shell(self):
        for program in PROGRAMS:
            texts = {
                "man": gzip.decompress((SHARE / f"man/man1/{program}.1.gz").read_bytes()).decode().replace("\\-", "-"),
                "bash": (SHARE / f"bash-completion/completions/{program}").read_text(),
                "zsh": (SHARE / f"zsh/vendor-completions/_{program}").read_text(),
                "fish": re.sub(r" -l (?=\w)", " --", (SHARE / f"fish/vendor_completions.d/{program}.fish").read_text()),
            }
            options = options_of(program)
            self.assertGreaterEqual(len(options), 8, program)
            for shell, text in texts.items():
                said = set(re.findall(r"--[\w-]+", text))
                self.assertEqual([option for option in options if option not in said], [], f"{program} in {shell}")

    def test_a_text_that_stands_below_its_option_belongs_to_it(self):
        page = gzip.decompress((SHARE / "man/man1/geoloc_replay.1.gz").read_bytes()).decode()
        entry = re.search(r"\\-\\-http\\-token\\fR \\fIFILE\\fR\n(.*)", page)[1]
        self.assertEqual(entry, "The page asks for the token in this file, which is made where it is not there. Only with \\-\\-http.")
        self.assertIn("Times the recorded speed; 0: as fast as it computes.", page)
        self.assertIn("From 0 to 1000.", page)

    @unittest.skipUnless(shutil.which("groff"), "needs groff")
    def test_groff_has_nothing_to_say_against_the_pages(self):
        for program in PROGRAMS:
            page = gzip.decompress((SHARE / f"man/man1/{program}.1.gz").read_bytes())
            shown = subprocess.run(["groff", "-man", "-ww", "-Tutf8"], input=page, capture_output=True, check=True)
            self.assertEqual(shown.stderr.decode(), "", program)

    def complete(self, *words):
        """What bash makes of the last word."""
        script = (f'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _{words[0]}; printf "%s\\n" "${{COMPREPLY[@]}}"')
        done = subprocess.run(["bash", "-c", script, "bash", SHARE / f"bash-completion/completions/{words[0]}", *words],
                              capture_output=True, text=True, check=True, cwd=self.folder)
        self.assertEqual(done.stderr, "")
        return done.stdout.split()

    def test_bash_completes_options_values_and_commands(self):
        self.assertEqual(self.complete("geoloc_app", "--meth"), ["--method"])
        self.assertEqual(self.complete("geoloc_sim", "--gimbal", "n"), ["nadir"])
        self.assertEqual(self.complete("geoloc_import", "st"), ["stills"])
        self.assertEqual(self.complete("geoloc_import", "video", "--layout", "yolov"), ["yolov5"])
        self.assertEqual(self.complete("geoloc_replay", "--speed", ""), [])
        self.write("flight.onnx", "")
        (self.folder / "flight").mkdir()
        self.assertEqual(sorted(self.complete("geoloc_app", "--model", "fl")), ["flight", "flight.onnx"])
        self.assertEqual(self.complete("geoloc_app", "--record", "fl"), ["flight"])


if __name__ == "__main__":
    unittest.main()
