/* What openapi.json says of keyframes (scene/timeline.h): members of a request's object, as text. */
#ifndef KD_SERVER_OPENAPI_TIMELINE_H
#define KD_SERVER_OPENAPI_TIMELINE_H

#define KD_OPENAPI_SCENE "{\"$ref\":\"#/components/schemas/Scene\"}"
#define KD_OPENAPI_OBJECT "{\"type\":\"object\",\"additionalProperties\":false,"

/* place: what a keyframe's place is called, a string constant; schema: of it. */
#define KD_OPENAPI_TIMELINE(place, schema)                                                                                        \
    "\"keyframes\":{\"type\":\"array\",\"minItems\":1,\"maxItems\":1000,\"items\":" KD_OPENAPI_OBJECT "\"required\":[\"" place "\"],"     \
    "\"anyOf\":[{\"required\":[\"scene\"]},{\"required\":[\"proper_time\"]}],\"properties\":{\"" place "\":" schema ",\"scene\":"         \
    KD_OPENAPI_SCENE ",\"proper_time\":{\"anyOf\":[{\"type\":\"number\",\"minimum\":0},{\"enum\":[\"horizon\",\"end\"]}]}}}},"            \
    "\"interpolation\":{\"enum\":[\"linear\",\"smooth\"]},\"distances\":{\"enum\":[\"linear\",\"geometric\"]}"

#endif
