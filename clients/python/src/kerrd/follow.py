"""A session that is watched and changed at the same time: one thread sends changes, another fetches frames. It does not
depend on Jupyter."""

from __future__ import annotations

import atexit
import threading
from collections.abc import Callable, Mapping
from time import monotonic
from typing import Any

import httpx

from .client import Client, Session
from .document import Document, SceneLike, patch_of, scene_of
from .errors import KerrdError, Problem
from .frame import Frame

MOST_UNSHOWN = 2  # largest number of frames that were sent to the viewer but not acknowledged yet
DEAF_S = 0.25  # seconds after which a frame counts as shown while a running cell prevents acknowledgements
# seconds without a message after which a viewer counts as gone; a hidden page sends a message each minute
PRESENCE_S = 150
AGAIN_S = 2.0  # seconds between two attempts to reach the server
REFRESH_S = 0.2  # seconds between two requests for a scene that moves by itself


def sentence(error: BaseException) -> str:
    """The text of a failure for the user."""
    if isinstance(error, Problem):
        return error.detail or str(error)
    return str(error.args[0]) if isinstance(error, KeyError) else str(error)


def _end(session: Session) -> None:
    try:
        session.close()
    except (KerrdError, httpx.HTTPError, RuntimeError):
        pass  # no error is raised here, because the server ends the session within a minute


class Follower:
    """Keeps a session, and opens a new one with the same scene if the server has ended it. Frames are fetched only
    while there is a viewer or a call that waits for a frame.

    Callbacks: took(scene) is called when the scene has changed. show(frame, serial) shows a frame, which the viewer
    then acknowledges by shown(serial). complain(text) gets an error message, or "" when the error is over. At most
    MOST_UNSHOWN frames are sent without acknowledgement. Of the frames that arrive in the meantime only the newest is
    kept. The callbacks run on any thread; calls of `took` never overlap. The constructor raises Problem if the server
    refuses the scene.
    """

    def __init__(
        self,
        client: Client,
        scene: SceneLike,
        changes: Mapping[str, Any],
        *,
        preset: str | None = None,
        quality: int | None = None,
    ) -> None:
        self.client = client
        self.quality = quality
        self.took: Callable[[Document], None] = lambda scene: None
        self.show: Callable[[Frame, int], None] = lambda frame, serial: None
        self.complain: Callable[[str], None] = lambda text: None
        self._session: Session = client.session(scene_of(scene, changes), preset=preset, quality=quality)
        self.scene: Document = self._session.scene
        self._patching = threading.RLock()  # held while a change is sent, so that scenes arrive in order
        self._sending = threading.RLock()  # held while a frame is sent, so that frames arrive in order
        self._state = threading.Condition()  # guards all members below
        self._waiting: dict[str, Any] = {}
        self._answers: list[Callable[[], None]] = []
        self._views: dict[str, float] = {}
        self._waiters = 0
        self._unshown: list[tuple[int, float]] = []  # serial number and time of sending of each unacknowledged frame
        self._unsent = False
        self._serial = 0
        self._frame: Frame | None = None
        self._of: Session | None = None  # session that the newest frame belongs to
        self._faults = {"change": "", "frame": ""}
        self._failures = 0
        self._closed = False
        self._threads = [
            threading.Thread(target=work, name=f"kerrd-{work.__name__.strip('_')}", daemon=True)
            for work in (self._tell, self._fetch)
        ]

    def start(self) -> None:
        atexit.register(self.close)
        for thread in self._threads:
            thread.start()

    def close(self) -> None:
        """Ends the session and both threads. A second call does nothing."""
        with self._state:
            if self._closed:
                return
            self._closed = True
            self._state.notify_all()
        atexit.unregister(self.close)
        _end(self._session)
        for thread in self._threads:
            if thread is not threading.current_thread() and thread.is_alive():
                thread.join(2)

    def change(self, patch: Callable[[Document], Document]) -> None:
        """Sends the merge patch that patch(scene) returns, and waits for the answer. Raises Problem if the server
        refuses the patch."""
        self._attempt(lambda: self._patch(patch(self.scene)))

    def replace(self, scene: Callable[[Document], Document]) -> None:
        """Replaces the scene by what scene(current) returns. Raises Problem if the server refuses the new scene. Opens
        a new session, because a merge patch cannot remove settings."""
        self._attempt(lambda: self._exchange(scene(self.scene)))

    def later(self, changes: Mapping[str, Any], answer: Callable[[], None]) -> None:
        """Changes fields, by dotted path, without waiting. If a field is changed several times before a request, only
        the last value is sent. answer() is called when the server has accepted or refused the changes."""
        with self._state:
            self._waiting.update(changes)
            self._answers.append(answer)
            self._state.notify_all()

    def watch(self, view: str, *, anew: bool = False) -> None:
        """Registers a viewer, which must call this again within PRESENCE_S. anew: the viewer has no frame to show
        yet."""
        with self._state:
            self._views[view] = monotonic()
            if anew:
                self._unshown.clear()
                self._unsent = self._frame is not None
            self._state.notify_all()
        self._send()

    def leave(self, view: str) -> None:
        with self._state:
            self._views.pop(view, None)

    def shown(self, serial: int) -> None:
        """Acknowledges a frame and all frames before it."""
        with self._state:
            self._unshown = [sent for sent in self._unshown if sent[0] > serial]
            self._state.notify_all()
        self._send()

    def deaf(self) -> None:
        """To be called while the caller's thread cannot receive acknowledgements. From then on the oldest frame counts
        as shown after DEAF_S seconds. Without this, a loop in a cell would show no animation."""
        with self._state:
            if self._unshown and monotonic() - self._unshown[0][1] > DEAF_S:
                del self._unshown[0]
                self._state.notify_all()
        self._send()

    def frame(self, *, final: bool, timeout: float) -> Frame:
        """The newest frame of the current scene. final: waits for the finest frame; of a moving scene, returns the
        newest frame. timeout: seconds to wait. Raises KerrdError if no frame comes."""

        def there() -> bool:
            session, frame = self._session, self._frame
            return (
                frame is not None
                and self._of is session
                and frame.revision >= session.revision
                and (frame.final or session.moves or not final)
            )

        with self._state:
            failures = self._failures
            self._waiters += 1
            self._state.notify_all()
            try:
                self._state.wait_for(lambda: self._closed or self._failures > failures or there(), timeout)
            finally:
                self._waiters -= 1
            if there() and self._frame is not None:
                return self._frame
            raise KerrdError(
                ("this view is closed" if self._closed else "")
                or self._faults["frame"]
                or f"no picture came within {timeout:g} s"
            )

    def _attempt(self, work: Callable[[], None]) -> None:
        with self._patching:
            try:
                work()
                self.scene = self._session.scene
                self.took(self.scene)
            except Exception as error:
                self._fault("change", sentence(error))
                raise
            self._fault("change", "")
            with self._state:
                self._state.notify_all()

    def _exchange(self, scene: Document) -> None:
        before, self._session = self._session, self.client.session(scene, quality=self.quality)
        _end(before)

    def _patch(self, patch: Document) -> None:
        try:
            self._session.patch(patch)
        except Problem as problem:
            if problem.status != 404:
                raise
            self._reopen(self._session)
            self._session.patch(patch)

    def _reopen(self, ended: Session) -> None:
        """Opens a new session in place of one that has ended, unless another thread has already opened one."""
        with self._patching:
            if self._session is ended and not self._closed:
                self._session = self.client.session(self.scene, quality=self.quality)

    def _fault(self, of: str, text: str) -> None:
        with self._state:
            if of == "frame" and text:
                self._failures += 1
                self._state.notify_all()
            changed = self._faults[of] != text
            self._faults[of] = text
            told = self._faults["frame"] or self._faults["change"]
        if changed and not self._closed:
            self.complain(told)

    def _tell(self) -> None:
        """The thread that sends changes."""
        while True:
            with self._state:
                self._state.wait_for(lambda: self._closed or self._answers)
                if self._closed:
                    return
                changes, answers = self._waiting, self._answers
                self._waiting, self._answers = {}, []
            try:
                self.change(lambda scene: patch_of(scene, changes))
            except Exception:  # continues: the error was reported already, and the scene is unchanged
                pass
            for answer in answers:
                answer()

    def _wanted(self) -> bool:
        now = monotonic()
        self._views = {view: heard for view, heard in self._views.items() if now - heard < PRESENCE_S}
        return self._waiters > 0 or (bool(self._views) and len(self._unshown) < MOST_UNSHOWN)

    def _fetch(self) -> None:
        """The thread that fetches frames."""
        looked = 0.0
        while True:
            with self._state:
                self._state.wait_for(lambda: self._closed or self._wanted())
                if self._closed:
                    return
                session = self._session
            try:
                self._next(session)
                if session.moves and monotonic() - looked > REFRESH_S:
                    self._look(session)
                    looked = monotonic()
                self._fault("frame", "")
            except Exception as error:
                if self._closed:
                    return
                revision = session.revision
                self._fault("frame", sentence(error))
                with self._state:
                    self._state.wait_for(lambda: self._closed or session.revision != revision, AGAIN_S)

    def _next(self, session: Session) -> None:
        try:
            frame = session.frame()
        except Problem as problem:
            if problem.status != 404 or self._closed:
                raise
            return self._reopen(session)
        if frame is None:
            return
        with self._state:
            self._frame, self._of, self._unsent = frame, session, True
            self._serial += 1
            self._state.notify_all()
        self._send()

    def _look(self, session: Session) -> None:
        with self._patching:
            if session is self._session:
                self.scene = session.refresh()
                self.took(self.scene)

    def _send(self) -> None:
        """Sends the newest frame, unless it was sent already or too many frames are unacknowledged. Only one thread
        sends at a time, so that no frame overtakes another."""
        with self._sending:
            self._send_newest()

    def _send_newest(self) -> None:
        with self._state:
            if (
                self._closed
                or not self._unsent
                or not self._views
                or len(self._unshown) >= MOST_UNSHOWN
                or self._frame is None
            ):
                return
            self._unsent = False
            self._unshown.append((self._serial, monotonic()))
            frame, serial = self._frame, self._serial
        self.show(frame, serial)
