#include "server/openapi_sessions.h"

#include "render/particle_list.h"

void kd_openapi_strike_body(cJSON *operation)
{
    cJSON_AddItemToObject(operation, "requestBody",
                          cJSON_Parse("{\"required\":false,\"content\":{\"application/json\":{\"schema\":{\"type\":\"object\","
                                      "\"additionalProperties\":false,\"properties\":{\"amplitude\":{\"type\":\"number\","
                                      "\"minimum\":0,\"maximum\":1,\"description\":"
                                      "\"style.ringdown; without it, what that is, or 1 where it is 0\"}}}}}}"));
}

void kd_openapi_particles_parameters(cJSON *list)
{
    static const struct { const char *name, *help, *schema; } known[] = {
        { "first", "number of the first particle; 0 without it", "{\"type\":\"integer\",\"minimum\":0}" },
        { "stride", "from one to the next; 1 without it", "{\"type\":\"integer\",\"minimum\":1}" },
        { "count", "how many; without it, as many as there are", "{\"type\":\"integer\",\"minimum\":1}" },
        { "time", "M; without it, the session's now", "{\"type\":\"number\",\"minimum\":-1e12,\"maximum\":1e12}" },
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        cJSON *o = cJSON_CreateObject();
        cJSON_AddStringToObject(o, "name", known[i].name);
        cJSON_AddStringToObject(o, "in", "query");
        cJSON_AddStringToObject(o, "description", known[i].help);
        cJSON_AddItemToObject(o, "schema", cJSON_Parse(known[i].schema));
        cJSON_AddItemToArray(list, o);
    }
    cJSON *fields = cJSON_Parse("{\"name\":\"fields\",\"in\":\"query\",\"style\":\"form\",\"explode\":false,\"description\":"
                                "\"columns of a row; x,y,z without it\",\"schema\":{\"type\":\"array\",\"uniqueItems\":true,"
                                "\"items\":{}}}");
    cJSON *schema = cJSON_GetObjectItemCaseSensitive(fields, "schema");
    cJSON *names = cJSON_AddArrayToObject(cJSON_GetObjectItemCaseSensitive(schema, "items"), "enum");
    for (int i = 0; i < KD_PARTICLE_N_COLUMNS; i++)
        cJSON_AddItemToArray(names, cJSON_CreateString(kd_particle_column_name((enum kd_particle_column)i)));
    cJSON_AddItemToArray(list, fields);
}
