#include "server/openapi/lessons.h"

#include "base/schema.h"
#include "server/lesson/lesson.h"
#include "server/http/request.h"
#include "server/openapi/media.h"
#include "server/openapi/strict.h"

#define ID "{\"type\":\"string\",\"pattern\":\"^[0-9a-f]{16}$\"}"
#define CHOICE "{\"type\":\"integer\",\"minimum\":0,\"maximum\":5}"
#define CHOICE_OR_NULL "{\"type\":[\"integer\",\"null\"],\"minimum\":0,\"maximum\":5}"
/* a text without the control characters of kd_utf8_is_control */
#define TEXT(least, most) \
    "{\"type\":\"string\",\"minLength\":" #least ",\"maxLength\":" #most \
    ",\"pattern\":\"^[^\\u0000-\\u001f\\u007f-\\u009f]*$\"}"

_Static_assert(KD_LESSON_CHOICES == 6 && KD_LESSON_TEXT == 600 && KD_LESSON_CHOICE == 200 && KD_LESSON_LINK == 8000 &&
                   KD_LESSON_ABOUT == 1000 && KD_LESSON_NAME == 80 && KD_LESSON_LANG == 35,
               "the schemas say so");

#define QUESTION_MEMBERS \
    "\"text\":" TEXT(1, 600) ",\"choices\":{\"type\":\"array\",\"minItems\":2,\"maxItems\":6,\"items\":" TEXT( \
        1, 200) "},\"right\":" CHOICE_OR_NULL

#define MEMBERS \
    "\"additionalProperties\":false,\"properties\":{\"session\":" ID ",\"link\":" TEXT(0, 8000) ",\"about\":" TEXT( \
        0, \
        1000) ",\"lang\":{\"type\":\"string\",\"maxLength\":35,\"pattern\":\"^[A-Za-z]{2,8}(-[A-Za-z0-9]{1,8})*$\"," \
              "\"description\":\"language of about and " \
              "question\"},\"open\":{\"type\":\"boolean\",\"description\":\"whether the question accepts answers\"}," \
              "\"question\":{\"type\":[\"object\",\"null\"],\"additionalProperties\":false,\"required\":[\"text\"," \
              "\"choices\"],\"properties\":{" QUESTION_MEMBERS "}}}"

void kd_openapi_lesson_schema(struct kd_json *json)
{
    static const struct kd_openapi_member question[] = {
        { "number", KD_SCHEMA_COUNT, false },
        { "text", KD_SCHEMA_TEXT, false },
        { "choices", KD_SCHEMA_LIST(KD_SCHEMA_TEXT), false },
        { "open", KD_SCHEMA_BOOL, false },
        { "answered", KD_SCHEMA_COUNT, false },
        { "right", CHOICE_OR_NULL, true },
        { "tally", KD_SCHEMA_LIST(KD_SCHEMA_COUNT), true },
    };
    static const struct kd_openapi_member hand[] = { { "name", KD_SCHEMA_TEXT, false },
                                                     { "choice", CHOICE_OR_NULL, false } };
    static const struct kd_openapi_member lesson[] = {
        { "id", ID, false },
        { "token", KD_SCHEMA_TEXT, true },
        { "session", ID, false },
        { "link", KD_SCHEMA_TEXT, false },
        { "about", KD_SCHEMA_TEXT, false },
        { "lang", KD_SCHEMA_TEXT, false },
        { "pupils", KD_SCHEMA_COUNT, false },
        { "question", "{\"oneOf\":[{\"type\":\"null\"}," KD_SCHEMA_REF("LessonQuestion") "]}", false },
        { "choice", CHOICE_OR_NULL, true },
        { "copies", KD_SCHEMA_BOOL, true },
        { "hands", KD_SCHEMA_LIST(KD_SCHEMA_REF("LessonHand")), true },
    };
    KD_OPENAPI_STRICT(json, "LessonQuestion", question);
    KD_OPENAPI_STRICT(json, "LessonHand", hand);
    KD_OPENAPI_STRICT(json, "Lesson", lesson);
    kd_schema_text(json, "NewLesson", "{\"type\":\"object\",\"required\":[\"session\"]," MEMBERS "}");
    kd_schema_text(json, "LessonChange", "{\"type\":\"object\"," MEMBERS "}");
}

const char kd_openapi_hand_schema[] =
    "{\"type\":\"object\",\"additionalProperties\":false,\"required\":[\"pupil\"],\"dependentRequired\":{"
    "\"question\":[\"choice\"],\"choice\":[\"question\"]},\"properties\":{\"pupil\":" ID ",\"name\":" TEXT(
        0, 80) ",\"question\":{\"type\":\"integer\",\"minimum\":1,\"maximum\":1000000000},\"choice\":" CHOICE "}}";
