/* Keyframes (scene/timeline.h) in openapi.json: the members of a request's object, as text. */
#ifndef KD_SERVER_OPENAPI_TIMELINE_H
#define KD_SERVER_OPENAPI_TIMELINE_H

#include "scene/timeline.h"

/* clang-format off */
#define KD_OPENAPI_SCENE "{\"$ref\":\"#/components/schemas/Scene\"}"
#define KD_OPENAPI_OBJECT "{\"type\":\"object\",\"additionalProperties\":false,"

#define KD_OPENAPI_TEXT__(x) #x
#define KD_OPENAPI_TEXT_(x) KD_OPENAPI_TEXT__(x)
#define KD_OPENAPI_WORD_(word) "\"" word "\""
#define KD_OPENAPI_WORDS_(list) "{\"enum\":[" list(KD_OPENAPI_WORD_, ",") "]}"
#define KD_OPENAPI_NUMBER_(least, most) "{\"type\":\"number\",\"minimum\":" least ",\"maximum\":" most "}"
#define KD_OPENAPI_MANNER_ \
    "\"ease\":" KD_OPENAPI_WORDS_(KD_EASES) "," \
    "\"look_at\":{\"anyOf\":[{\"enum\":[\"hole\",\"free\"]}," KD_OPENAPI_OBJECT "\"properties\":{" \
        "\"r\":" KD_OPENAPI_NUMBER_("0", KD_OPENAPI_TEXT_(KD_LOOK_AT_FAR)) "," \
        "\"theta_deg\":" KD_OPENAPI_NUMBER_("0", "180") "," \
        "\"phi_deg\":" KD_OPENAPI_NUMBER_("-360", "360") "}}]}"

/* The members of a request's object. place: a string literal, the name of the member with a keyframe's place.
 * schema: the schema of that member. */
#define KD_OPENAPI_TIMELINE(place, schema) \
    "\"keyframes\":{\"type\":\"array\",\"minItems\":1," \
        "\"maxItems\":" KD_OPENAPI_TEXT_(KD_TIMELINE_KEYS_MAX) "," \
        "\"items\":" KD_OPENAPI_OBJECT "\"required\":[\"" place "\"]," \
        "\"anyOf\":[{\"required\":[\"scene\"]},{\"required\":[\"proper_time\"]},{\"required\":[\"look_at\"]}]," \
        "\"properties\":{\"" place "\":" schema ",\"scene\":" KD_OPENAPI_SCENE "," \
            "\"proper_time\":{\"anyOf\":[{\"type\":\"number\",\"minimum\":0,\"maximum\":1e12}," \
                                        "{\"enum\":[\"horizon\",\"end\"]}]}," \
            KD_OPENAPI_MANNER_ "}}}," \
    "\"interpolation\":" KD_OPENAPI_WORDS_(KD_INTERPOLATIONS) "," \
    "\"distances\":" KD_OPENAPI_WORDS_(KD_DISTANCES) "," \
    "\"angles\":" KD_OPENAPI_WORDS_(KD_ANGLES) "," KD_OPENAPI_MANNER_
/* clang-format on */

#endif
