#include "server/openapi_sessions.h"

void kd_openapi_strike_body(cJSON *operation)
{
    cJSON_AddItemToObject(operation, "requestBody",
                          cJSON_Parse("{\"required\":false,\"content\":{\"application/json\":{\"schema\":{\"type\":\"object\","
                                      "\"additionalProperties\":false,\"properties\":{\"amplitude\":{\"type\":\"number\",\"minimum\":0,"
                                      "\"maximum\":1,\"description\":\"style.ringdown; without it, what that is, or 1 where it is 0\"}}}}}}"));
}
