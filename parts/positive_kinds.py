"""Kinds of parts that positive-drive and sliding cams are made of: their keys, what checks them, what makes them."""

from __future__ import annotations

from typing import Any

from msgspec import Struct

from parts.conjugate_cam import ConjugateCamSpec, checked_conjugate, conjugate_part
from parts.groove_cam import GrooveCamSpec, checked_groove, groove_part
from parts.groove_piece import GroovePieceSpec, checked_piece, piece_part
from parts.wedge_cam import WedgeCamSpec, checked_wedge, wedge_part
from parts.yoke_frame import YokeFrameSpec, checked_yoke, yoke_part

POSITIVE_KINDS: dict[str, tuple[type[Struct], Any, Any]] = {
    "groove_cam": (GrooveCamSpec, checked_groove, groove_part),
    "groove_piece": (GroovePieceSpec, checked_piece, piece_part),
    "conjugate_cam": (ConjugateCamSpec, checked_conjugate, conjugate_part),
    "yoke_frame": (YokeFrameSpec, checked_yoke, yoke_part),
    "wedge_cam": (WedgeCamSpec, checked_wedge, wedge_part),
}
