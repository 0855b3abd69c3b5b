"""A live view in a notebook's cell: kerrd.widget(...). Needs the package anywidget (pip install kerrd[jupyter]).

Frames go from the server's session to the kernel (follow.py), and from there over the kernel's comm to widget.js. The
browser therefore needs no connection to the server.
"""

from __future__ import annotations

import copy
import io
import threading
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import anywidget
import traitlets

from .client import Client
from .document import Document, Open, SceneLike, dataclass_of, patch_of, scene_of
from .errors import KerrdError
from .fields import Fields
from .follow import Follower
from .frame import Frame
from .local import local
from .names import checked
from .scene import Scene

USUAL = ("spacetime.spin", "camera.inclination_deg", "disk.outer", "style.exposure")
WIDTH = 640  # default width of a picture, in pixels
PATIENCE_S = 60.0  # seconds to wait for a requested frame
# when a notebook saves a picture: seconds to wait for the finest frame, and then for any frame
FINEST_S, SHOW_S = 2.0, 10.0

_starting = threading.Lock()
_own: local | None = None


def own_server() -> Client:
    """The server that all widgets of this process share by default. A new one is started if the last has died."""
    global _own
    with _starting:
        if _own is not None and _own.process.poll() is not None:
            _own.close()
            _own = None
        if _own is None:
            _own = local()
        return _own


class _Taken:
    """A scene that the server has already accepted. The trait takes it without sending it."""

    def __init__(self, document: Document) -> None:
        self.scene = dataclass_of(document, Scene)


class _SceneTrait(traitlets.TraitType[Any, Any]):
    """A kerrd.Scene with every field. Reading returns a copy. A new value is sent to the server first; if the server
    refuses it, the trait keeps its old value."""

    def validate(self, obj: Any, value: Any) -> Scene:
        return value.scene if isinstance(value, _Taken) else obj._replaced(value)

    def get(self, obj: Any, cls: Any = None) -> Scene | None:
        return copy.deepcopy(super().get(obj, cls))


class Widget(anywidget.AnyWidget):
    """A view of a black hole, moved and changed by hand, in a notebook's cell."""

    _esm = Path(__file__).with_name("widget.js")
    _css = Path(__file__).with_name("widget.css")
    scene = _SceneTrait().tag(sync=True, to_json=lambda scene, widget: widget._follower.scene)
    error = traitlets.Unicode("").tag(sync=True)
    _controls: Any = traitlets.List().tag(sync=True)

    def __init__(
        self,
        scene: SceneLike = None,
        client: Client | str | Open | None = None,
        controls: Sequence[str] | Open = USUAL,
        *,
        preset: str | Open | None = None,
        quality: int | Open | None = 80,
        **changes: Any,
    ) -> None:
        if client is not None and not isinstance(client, (Client, str)):
            raise KerrdError(
                f"client is a {type(client).__name__}; it must be a kerrd.Client, kerrd.local() or the address of a server"
            )
        hole = Client(client) if isinstance(client, str) else client or own_server()
        self._fields = Fields(hole.schema())
        wanted = [self._fields.control(name) for name in ([controls] if isinstance(controls, str) else controls)]
        document = scene_of(scene, self._fields.document(changes))
        self._follower = Follower(hole, document, {}, preset=preset, quality=quality)
        try:
            self._begin(document)
            for field in wanted:
                patch_of(self._follower.scene, {field.path: None})  # raises KeyError for an element that does not exist
        except BaseException:
            self._follower.close()
            raise
        super().__init__(scene=_Taken(self._follower.scene), _controls=[field.control() for field in wanted])
        self._follower.took = self._took
        self._follower.show = self._show
        self._follower.complain = lambda text: self.set_trait("error", text)
        self.on_msg(self._heard)
        if self.comm is not None and hasattr(self.comm, "on_close"):
            self.comm.on_close(lambda message: self._follower.close())
        self._follower.start()

    def _begin(self, document: Document) -> None:
        """Limits the width of the picture to WIDTH, unless its size was given."""
        image = self._follower.scene["image"]
        if not {"width", "height"} & document.get("image", {}).keys() and image["width"] > WIDTH:
            self._follower.change(
                lambda scene: {"image": {"width": WIDTH, "height": round(image["height"] * WIDTH / image["width"])}}
            )

    def set(self, **changes: Any) -> None:
        """Changes the scene: set(spin=0.9, camera={"inclination_deg": 60}, disk__outer=30). A field is named by its
        path, or by the path's last part if that is unique. Raises Problem for a refused value, and KerrdError for an
        unknown name; the scene then stays as it was."""
        named = self._fields.document(changes)
        self._follower.change(lambda scene: patch_of(scene, named))
        self._follower.deaf()

    @property
    def frame(self) -> Frame:
        """The newest frame of the current scene. Waits for the frame; raises KerrdError if none comes."""
        return self._follower.frame(final=False, timeout=PATIENCE_S)

    @property
    def png(self) -> bytes:
        """The finest picture of the current scene as the bytes of a PNG; for a moving scene, the newest picture. Waits
        for the picture; raises KerrdError if none comes."""
        frame = self._follower.frame(final=True, timeout=PATIENCE_S)
        return frame.data if frame.kind == "image/png" else _encoded(frame, "PNG")

    def save(self, path: str) -> None:
        """Writes the current scene's picture as a PNG that holds the scene, from which `kerrd render --from` renders it
        again."""
        checked(path, "png")
        self._follower.client.render(self._follower.scene).save(path)

    def close(self) -> None:
        """Removes the widget and ends its session. Both also happen when the kernel ends."""
        super().close()
        if hasattr(self, "_follower"):
            self._follower.close()

    def _replaced(self, scene: SceneLike) -> Scene:
        document = scene_of(scene, {})

        def sized(now: Document) -> Document:
            return {
                **document,
                "image": {**{name: now["image"][name] for name in ("width", "height")}, **document.get("image", {})},
            }

        self._follower.replace(sized)
        self._follower.deaf()
        return dataclass_of(self._follower.scene, Scene)

    def _took(self, scene: Document) -> None:
        self.set_trait("scene", _Taken(scene))

    def _show(self, frame: Frame, serial: int) -> None:
        self.send({"kind": "frame", "serial": serial, "type": frame.kind, "final": frame.final}, buffers=[frame.data])

    def _heard(self, widget: Any, message: Any, buffers: Any) -> None:
        """Handles a message of widget.js."""
        kind = message.get("kind")
        if kind == "change":
            self._follower.later(
                message["values"],
                lambda: self.send({"kind": "took", "view": message["view"], "scene": self._follower.scene}),
            )
        elif kind == "shown":
            self._follower.shown(int(message["serial"]))
        elif kind == "watch":
            self._follower.watch(message["view"], anew=bool(message.get("anew")))
        elif kind == "leave":
            self._follower.leave(message["view"])

    def _repr_mimebundle_(self, **kwargs: Any) -> Any:
        """What the notebook shows: the widget, and a still picture for when no kernel runs."""
        bundle: Any = super()._repr_mimebundle_(**kwargs)
        frame = self._within(FINEST_S, final=True) or self._within(SHOW_S, final=False)
        if frame is None:
            return bundle
        data = {"image/jpeg": _encoded(frame, "JPEG", self._follower.scene["image"]["height"])}
        return ({**bundle[0], **data}, bundle[1]) if isinstance(bundle, tuple) else {**bundle, **data}

    def _within(self, seconds: float, *, final: bool) -> Frame | None:
        try:
            return self._follower.frame(final=final, timeout=seconds)
        except KerrdError:
            return None


def _encoded(frame: Frame, kind: str, height: int | None = None) -> bytes:
    """The frame as a file of another format. height: height in pixels to which the picture is scaled."""
    file = io.BytesIO()
    image = frame.image.convert("RGB")
    if height is not None and height != image.height:
        image = image.resize((round(image.width * height / image.height), height))
    image.save(file, kind, quality=85)
    return file.getvalue()
