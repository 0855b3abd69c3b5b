"""What a picture comes as."""

from __future__ import annotations

import io
import json
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image


def items(header: str | None) -> list[str]:
    """A header that is a list of names, such as Kerrd-Approximations."""
    return [name for name in map(str.strip, (header or "").split(",")) if name]


def figures(header: str | None) -> dict[str, float | str]:
    """A header of name=value pairs, such as Kerrd-Accuracy; numbers as numbers."""
    out: dict[str, float | str] = {}
    for pair in (header or "").split():
        name, _, value = pair.partition("=")
        try:
            out[name] = float(value)
        except ValueError:
            out[name] = value
    return out


def passes(header: str | None) -> dict[str, float]:
    """Server-Timing: milliseconds of each pass, of `total` and of `encode`."""
    return {name: float(ms) for name, ms in re.findall(r"(\w+)(?:;desc=\"[^\"]*\")?;dur=([\d.]+)", header or "")}


@dataclass(frozen=True)
class Frame:
    """A picture, and what came with it.

    data: the file's bytes; kind: its media type. layers: numbers by name as float32 of shape (height, width), rgb
    (height, width, 3); those that were asked for. accuracy: Kerrd-Accuracy as numbers. timing: milliseconds a pass.
    quality, number and revision: of a session's frame alone.
    """

    data: bytes
    kind: str
    headers: Mapping[str, str]
    layers: dict[str, NDArray[np.float32]] = field(default_factory=dict)
    # of approximations by name, of all that the server knows
    sentences: dict[str, str] = field(default_factory=dict, repr=False)

    @property
    def png(self) -> bytes:
        """The PNG's bytes, which carry the scene: kerrd renders it again by `kerrd render --from`."""
        if self.kind != "image/png":
            raise ValueError(f"this picture came as {self.kind}; only the last one of a scene that rests is a PNG")
        return self.data

    @cached_property
    def image(self) -> Image.Image:
        image = Image.open(io.BytesIO(self.data))
        image.load()
        return image

    @cached_property
    def array(self) -> NDArray[np.uint8]:
        """The pixels as they are shown, uint8 of shape (height, width, 3); numbers of physics are `layers`."""
        return np.asarray(self.image.convert("RGB"), dtype=np.uint8)

    @cached_property
    def scene(self) -> dict[str, Any]:
        """The whole scene, every field named, as the picture carries it."""
        text = getattr(self.image, "text", {}).get("kerrd:scene")
        if text is None:
            raise ValueError(f"a picture of the type {self.kind} carries no scene")
        scene: dict[str, Any] = json.loads(text)
        return scene

    @property
    def accuracy(self) -> dict[str, float | str]:
        return figures(self.headers.get("kerrd-accuracy"))

    @property
    def approximations(self) -> list[str]:
        """What it leaves out or chooses, in sentences."""
        return [self.sentences[name] for name in items(self.headers.get("kerrd-approximations"))]

    @property
    def timing(self) -> dict[str, float]:
        return passes(self.headers.get("server-timing"))

    @property
    def etag(self) -> str:
        return self.headers.get("etag", "")

    @property
    def quality(self) -> dict[str, float | str]:
        return figures(self.headers.get("kerrd-quality"))

    @property
    def number(self) -> int:
        return int(self.headers.get("kerrd-frame", 0))

    @property
    def revision(self) -> int:
        return int(self.headers.get("kerrd-revision", 0))

    @property
    def final(self) -> bool:
        """Whether nothing finer of this scene will come."""
        return not self.quality or self.quality.get("final") == 1

    def save(self, path: str) -> None:
        with open(path, "wb") as file:
            file.write(self.data)

    def _repr_png_(self) -> bytes | None:
        return self.data if self.kind == "image/png" else None

    def _repr_jpeg_(self) -> bytes | None:
        return self.data if self.kind == "image/jpeg" else None
