/* A table of fields of a scene other than kerrd's. It is used instead of src/scene/fields.h when
 * tests/unit/scene_table.c is compiled. It has two lists of different lengths with rows of each kind, and assets in a
 * section, in lists and in the document itself. */
#ifndef KD_SCENE_FIELDS_H
#define KD_SCENE_FIELDS_H

#define KD_PLACE_FIELDS(REAL, WORD, INT, BOOL, ENUM, ASSET, WORDS) \
    REAL(place, width, PHYSICS, FRONT, 2.0, 0.0, 10.0, "M", "how wide") \
    ASSET(place, map, MODEL, REST, "what lies there")
#define KD_BODIES_FIELDS(REAL, WORD, INT, BOOL, ENUM, ASSET, WORDS) \
    BOOL(bodies, dark, LOOK, FRONT, true, "whether it is dark") \
    ENUM(bodies, shape, MODEL, FRONT, 1, "its shape", "ball|disk|ring") \
    ASSET(bodies, texture, LOOK, REST, "its surface") \
    INT(bodies, moons, PHYSICS, REST, 3, 0, 9, "1", "how many moons") \
    WORD(bodies, r, MODEL, REST, INFINITY, 1.0, 50.0, "M", "where it is", "far")
#define KD_STOPS_FIELDS(REAL, WORD, INT, BOOL, ENUM, ASSET, WORDS) \
    REAL(stops, time, PHYSICS, FRONT, 0.5, -1.0, 1.0, "M", "when") \
    ASSET(stops, sound, LOOK, FRONT, "what is heard")
#define KD_TOP_FIELDS(REAL, WORD, INT, BOOL, ENUM, ASSET, WORDS) \
    REAL(top, time, PHYSICS, FRONT, 0.0, -5.0, 5.0, "M", "time") \
    ASSET(top, film, LOOK, REST, "all of it")

#define KD_SCENE_SECTIONS(SECTION, LIST) \
    LIST(bodies, body, KD_BODIES_FIELDS, GAS, 20, "bodies") \
    SECTION(place, KD_PLACE_FIELDS, CAMERA, "a place") \
    LIST(stops, stop, KD_STOPS_FIELDS, HOLE, 3, "stops") \
    SECTION(top, KD_TOP_FIELDS, MORE, "members of the document itself")
#define KD_SCENE_PARTS(PART, s)
#define KD_STYLES 1
#define KD_SCENE_STYLES(ROW)
/* clang-format off */
#define KD_SCENE_CONTROLS(SPAN, FIRST, SWITCH, WITH, VARIES, BUTTON) \
    SPAN("time", -1, 2) FIRST("bodies.r", 7) SWITCH("bodies.dark") WITH("bodies.moons", "shape", 2) \
    WITH("bodies.texture", "shape", 0) WITH("bodies.texture", "shape", 1) \
    VARIES("stops.time", "here|there") BUTTON("bodies.shape", 0, "A ball")
/* clang-format on */
#define KD_SCENE_OLD_NAMES(OLD) OLD(finish, stops, 2) OLD(start, stops, 0)

struct kd_spot;
#define KD_SPOTS 1 /* scene.h declares what only the other scene has */
#define KD_SCENE_BODIES 1

#endif
