# SPDX-License-Identifier: Apache-2.0
"""The program over an archive of recordings."""

from __future__ import annotations

import argparse
import json
import pathlib
import signal
import sys
from typing import Any

from .. import __version__
from ._run import run

_DONE, _FAILED, _UNUSABLE = 0, 1, 2  # exit statuses, as of all programs


def _parse(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        "python -m geoloc.archive",
        description="Replays all recordings of an archive, and fuses their flights into one map. What is done is kept, so that a run that"
        " was stopped goes on when it is started again.",
        epilog="Exit status: 0 all recordings are done, 1 some have failed (report.txt says why) or the run was stopped, 2 unusable arguments.",
    )
    parser.add_argument("places", nargs="+", metavar="DIR|GLOB", help="where recordings are, or lie below; a pattern in quotes is expanded here")
    parser.add_argument("--out", required=True, metavar="DIR", help="for results, the map and the report; made where it is missing")
    parser.add_argument("--ray", metavar="ADDRESS", help="Ray's workers: of the cluster at ray://HOST:PORT or HOST:PORT, or local: started here for this"
                        " run [processes of this computer]")
    parser.add_argument("--workers", type=int, metavar="N", help="recordings at a time, on this computer [its processors]")
    parser.add_argument("--config", metavar="FILE", help="settings, JSON, over each recording's own")
    parser.add_argument("--keep-going", action="store_true", help="skip bad lines of frames.jsonl")
    parser.add_argument("--tries", type=int, default=3, metavar="N", help="of a recording that fails, or whose worker dies [%(default)s]")
    parser.add_argument("--limit-s", type=float, default=3600.0, metavar="S", help="a recording that takes longer fails [%(default)g]")
    parser.add_argument("--version", action="version", version=f"geoloc {__version__}")
    options = parser.parse_args(arguments)
    if (options.workers is not None and options.workers < 1) or options.tries < 1 or not 0.0 < options.limit_s < 1e9:
        parser.error("--workers, --tries and --limit-s must be above 0")
    return options


def _config(file: str | None) -> dict[str, Any]:
    if file is None:
        return {}
    try:
        config = json.loads(pathlib.Path(file).read_bytes())
    except ValueError as error:
        raise ValueError(f"{file}: {error}") from error
    if not isinstance(config, dict):
        raise ValueError(f"{file}: must be a JSON object")
    return config


def _stop(*_: object) -> None:
    raise KeyboardInterrupt


def main(arguments: list[str] | None = None) -> int:
    """The program; its exit status."""
    options = _parse(arguments)
    signal.signal(signal.SIGTERM, _stop)
    try:
        report = run(options.places, options.out, _config(options.config), workers=options.workers, ray=options.ray,
                     keep_going=options.keep_going, tries=options.tries, limit_s=options.limit_s, shows_progress=True)
    except KeyboardInterrupt:
        print("geoloc.archive: stopped; the same command goes on with the rest", file=sys.stderr)
        return _FAILED
    except BlockingIOError:
        print(f"geoloc.archive: another run works on {options.out}", file=sys.stderr)
        return _UNUSABLE
    except ModuleNotFoundError as error:
        print(f"geoloc.archive: --ray needs Ray (pip install 'ray[client]'): {error}", file=sys.stderr)
        return _UNUSABLE
    except (ValueError, OSError) as error:
        print(f"geoloc.archive: {error}", file=sys.stderr)
        return _UNUSABLE
    except RuntimeError as error:  # a map or a report that cannot be written
        print(f"geoloc.archive: {error}", file=sys.stderr)
        return _FAILED
    print(report.to_text(), end="")
    return _DONE if report.is_complete else _FAILED


if __name__ == "__main__":
    sys.exit(main())
