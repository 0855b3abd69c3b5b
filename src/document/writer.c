#include "document/writer.h"

#include "document/number.h"

void kd_write_string(struct kd_writer *writer, const char *text)
{
    kd_write(writer, "\"");
    for (const char *c = text; *c; c++) {
        if (*c == '"' || *c == '\\')
            kd_write(writer, "\\%c", *c);
        else if ((unsigned char)*c < 0x20)
            kd_write(writer, "\\u%04x", (unsigned)*c);
        else
            kd_write(writer, "%c", *c);
    }
    kd_write(writer, "\"");
}

void kd_write_number(struct kd_writer *writer, double value)
{
    char number[KD_NUMBER_SIZE];
    kd_number_format(number, value == 0 ? 0 : value);
    kd_write(writer, "%s", number);
}
