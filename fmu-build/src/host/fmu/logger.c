/* The logger that FMUs call: formats the message and its variable arguments, and hands over the text. */

#include <stdarg.h>
#include <stdio.h>

/* Begins like `Log` in log.rs. */
struct log {
    void (*take)(struct log *log, int status, const char *category, const char *text);
};

void fmu_build_log(void *environment, const char *instance, int status, const char *category, const char *message, ...)
{
    struct log *log = environment;
    char text[4096];
    va_list arguments;

    (void)instance;
    if (log == NULL || message == NULL)
        return;
    va_start(arguments, message);
    vsnprintf(text, sizeof text, message, arguments);
    va_end(arguments);
    log->take(log, status, category, text);
}
