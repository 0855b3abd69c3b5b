"""Makes the requests of schemathesis cheap. Valid values are replaced by smaller valid ones, so that a valid case stays
valid and an invalid one stays invalid."""

import re

RANGE = re.compile(r"^([^:]+):([^:]+):(\d+)$")
WIDTH, HEIGHT = 40, 24

# By the name of a member of a body, at any depth: the largest value of a number, or the largest length of a list.
NUMBERS = {
    "bins": 8,
    "rings": 3,
    "g_stars": 3,
    "frequencies": 2,
    "baselines": 3,
    "pixels": 16,
    "frames": 3,
    "steps": 64,
    "count": 100,
}
LISTS = {
    "rays": 8,
    "orbits": 2,
    "scenes": 2,
    "bodies": 4,
    "add": 4,
    "spots": 3,
    "edges": 8,
    "radii": 3,
    "g_star": 3,
    "frequencies_hz": 2,
    "u": 3,
    "v": 3,
    "lengths": 2,
    "angles_deg": 2,
    "keyframes": 3,
}
DURATIONS = {"periods": 3, "time": 1e4}


def is_count(value):
    return (isinstance(value, int) and not isinstance(value, bool)) or (
        isinstance(value, float) and value.is_integer()
    )  # 8.0 counts as a whole number in JSON Schema


def smaller_image(image):
    """Makes an image smaller. Only objects are changed, and in these only sizes that are missing or valid."""
    if not isinstance(image, dict):
        return
    for name, most in (("width", WIDTH), ("height", HEIGHT)):
        value = image.get(name, 32768)
        if is_count(value) and most < value <= 32768:
            image[name] = most
    if image.get("samples") == "auto" or (is_count(image.get("samples")) and 1 < image["samples"] <= 64):
        image["samples"] = 1


def smaller_scene(scene, whole):
    """Makes a scene smaller. whole: adds a size if there is none, because a picture of the scene would otherwise have
    the default size."""
    if not isinstance(scene, dict):
        return
    if whole:
        scene.setdefault("image", {})
    smaller_image(scene.get("image"))


def smaller_duration(duration):
    """Makes the duration of an orbit shorter."""
    if isinstance(duration, dict):
        for name, most in DURATIONS.items():
            if (
                isinstance(duration.get(name), (int, float))
                and not isinstance(duration[name], bool)
                and duration[name] > most
            ):
                duration[name] = most


def smaller(value, name=""):
    """Applies the limits to everything inside a valid body, so that no number in it is too large."""
    if isinstance(value, list):
        if name in LISTS and len(value) > LISTS[name]:
            del value[LISTS[name] :]
        for one in value:
            smaller(one)
    if isinstance(value, dict):
        for key, one in value.items():
            most = NUMBERS.get(key)
            if most and is_count(one) and one > most:
                value[key] = most
            smaller(one, key)
        smaller_image(value.get("image"))
        smaller_duration(value.get("duration"))


def smaller_axes(axes):
    if isinstance(axes, dict):
        for name, values in axes.items():
            if isinstance(values, list):
                del values[2:]


SCENES = {"/v1/render", "/v1/pixel", "/v1/plan", "/v1/sessions"}
WITH_SCENES = {"/v1/jobs", "/v1/playground", "/v1/visibility", "/v1/compare", "/v1/observe", "/v1/spectrum", "/v1/plan"}


def smaller_job(path, value):
    if path == "/v1/playground" or "playground" in value or "axes" in value:
        value.setdefault("scene", {})
    if isinstance(value.get("sets"), list):
        del value["sets"][2:]
    if path in ("/v1/visibility", "/v1/compare", "/v1/observe") or (
        path == "/v1/spectrum" and {"scene", "preset"} & value.keys()
    ):
        value.setdefault("pixels", 16)
        if value.get("check") in (None, "finer"):
            value["check"] = "none"
        if path == "/v1/spectrum":
            value.setdefault("frequencies", 2)
        smaller_scene(value.get("scene"), False)
        return
    scenes = value["scenes"] if isinstance(value.get("scenes"), list) else []
    for one in [value.get("scene"), *scenes]:
        smaller_scene(one, True)
    smaller_axes(value.get("axes"))


def body(path, value, sound):
    """Makes a body smaller. sound: true if the body is valid by the schema. In an invalid body only pictures are made
    smaller, because a list that is too long must stay too long."""
    if not isinstance(value, dict):
        return
    if sound:
        smaller(value)
    if path.endswith("/step") and isinstance(value.get("by"), (int, float)) and 1 < value["by"] <= 1e12:
        value["by"] = 1
    if path in SCENES and "axes" not in value:
        smaller_scene(value, True)
    if sound and path in WITH_SCENES:
        smaller_job(path, value)


def query(path, value):
    """Makes a query, a mapping from names to values, smaller."""
    for name, one in value.items():
        match = RANGE.match(one) if isinstance(one, str) else None
        if match and 3 < int(match[3]) <= 100000:
            value[name] = f"{match[1]}:{match[2]}:3"
    if path in ("/v1/render", "/v1/pixel"):
        image = {name: value[f"image.{name}"] for name in ("width", "height", "samples") if f"image.{name}" in value}
        smaller_image(image)
        value.update({f"image.{name}": one for name, one in image.items()})
    for name, most in (("wait_ms", 5), ("at_most", 100)):
        if is_count(value.get(name)) and most < value[name] <= 60000:
            value[name] = most
