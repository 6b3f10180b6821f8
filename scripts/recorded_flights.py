# SPDX-License-Identifier: Apache-2.0
"""Flights of geoloc_sim and what geoloc_replay makes of them, for the scripts that make tables of the documents."""
import pathlib
import re
import subprocess
import typing

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILT = ROOT / "build" / "release" / "bin"


class Score(typing.NamedTuple):
    """What a replay ends with. rmse_m is None where no target was found."""
    found: int
    targets: int
    rmse_m: typing.Optional[float]
    extra: int
    said: str


def run(program, *arguments):
    """Runs a program to its end, and returns its messages."""
    done = subprocess.run([program, *map(str, arguments)], check=False, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{program} failed:\n{done.stderr}")
    return done.stderr


def simulate(bin_dir, recording, *options):
    """Writes a recording of a simulated flight."""
    run(bin_dir / "geoloc_sim", "--record", recording, *options)


def replay(bin_dir, recording, *options):
    """The score of a recording."""
    said = run(bin_dir / "geoloc_replay", recording, "--out", pathlib.Path(recording) / "objects.geojson", *options)
    found = re.search(r"found (\d+) / (\d+)", said)
    rmse = re.search(r"RMSE ([\d.]+)", said)
    return Score(int(found[1]), int(found[2]), float(rmse[1]) if rmse else None, int(re.search(r"extra (\d+)", said)[1]), said)


def mean_rmse_m(scores):
    """Of the runs in which anything was found."""
    errors_m = [score.rmse_m for score in scores if score.rmse_m is not None]
    return sum(errors_m) / len(errors_m)
