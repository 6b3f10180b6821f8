# SPDX-License-Identifier: Apache-2.0
"""Settings as the programs read them: JSON."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Mapping
from typing import Any

import numpy as np


def _plain(value: Any) -> Any:
    """JSON has no arrays of NumPy and no NaN; the latter becomes a text, so that it is refused under its name."""
    if isinstance(value, Mapping):
        return {str(key): _plain(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(entry) for entry in value]
    if isinstance(value, (np.ndarray, np.generic)):
        return _plain(value.tolist())
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    return value


def _merge(base: dict[str, Any], over: Mapping[str, Any]) -> dict[str, Any]:
    for key, value in over.items():
        both = isinstance(value, Mapping) and isinstance(base.get(key), dict)
        base[key] = _merge(base[key], value) if both else value
    return base


def to_json(value: Any) -> str:
    """As JSON. Raises TypeError for what has no form there."""
    return json.dumps(_plain(value), allow_nan=False)


def settings_json(settings: Mapping[str, Any] | None, more: Mapping[str, Any]) -> str:
    """Settings with others over them."""
    return to_json(_merge(_plain(settings or {}), _plain(more)))
