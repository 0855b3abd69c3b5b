/* What openapi.json says of keyframes (scene/timeline.h): members of a request's object, as text. */
#ifndef KD_SERVER_OPENAPI_TIMELINE_H
#define KD_SERVER_OPENAPI_TIMELINE_H

#define KD_OPENAPI_SCENE "{\"$ref\":\"#/components/schemas/Scene\"}"
#define KD_OPENAPI_OBJECT "{\"type\":\"object\",\"additionalProperties\":false,"

#define KD_OPENAPI_NUMBER_(least, most) "{\"type\":\"number\",\"minimum\":" least ",\"maximum\":" most "}"
#define KD_OPENAPI_MANNER_                                                                                                        \
    "\"ease\":{\"enum\":[\"none\",\"in\",\"out\",\"in-out\"]},\"look_at\":{\"anyOf\":[{\"enum\":[\"hole\",\"free\"]}," KD_OPENAPI_OBJECT         \
    "\"properties\":{\"r\":" KD_OPENAPI_NUMBER_("0", "1e12") ",\"theta_deg\":" KD_OPENAPI_NUMBER_("0", "180") ",\"phi_deg\":"        \
    KD_OPENAPI_NUMBER_("-360", "360") "}}]}"

/* place: what a keyframe's place is called, a string constant; schema: of it. */
#define KD_OPENAPI_TIMELINE(place, schema)                                                                                        \
    "\"keyframes\":{\"type\":\"array\",\"minItems\":1,\"maxItems\":1000,\"items\":" KD_OPENAPI_OBJECT "\"required\":[\"" place "\"],"     \
    "\"anyOf\":[{\"required\":[\"scene\"]},{\"required\":[\"proper_time\"]},{\"required\":[\"look_at\"]}],\"properties\":{\"" place "\":" schema ",\"scene\":"         \
    KD_OPENAPI_SCENE ",\"proper_time\":{\"anyOf\":[{\"type\":\"number\",\"minimum\":0},{\"enum\":[\"horizon\",\"end\"]}]},"             \
    KD_OPENAPI_MANNER_ "}}},\"interpolation\":{\"enum\":[\"linear\",\"smooth\",\"catmull-rom\"]},\"distances\":{\"enum\":[\"linear\",\"geometric\"]},"    \
    "\"angles\":{\"enum\":[\"as-given\",\"shorter\"]}," KD_OPENAPI_MANNER_

#endif
