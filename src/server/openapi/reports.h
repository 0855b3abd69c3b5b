/* Answers about the service itself in openapi.json: device, presets, quantities, plans, accuracy. */
#ifndef KD_SERVER_OPENAPI_REPORTS_H
#define KD_SERVER_OPENAPI_REPORTS_H

#include "base/json.h"

void kd_openapi_report_schemas(struct kd_json *json);

#endif
