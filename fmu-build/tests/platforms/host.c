/* A host for Windows and Linux: one second of a unit with its first joint moving, then some of its values.
 *
 *     host LIBRARY GUID INPUT OUTPUT...      (value references)
 */
#include <fenv.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

typedef void (*function)(void);

#ifdef _WIN32
#include <windows.h>

typedef HMODULE library;

static library load(const char *file) {
    library loaded = LoadLibraryA(file);
    if (!loaded) fprintf(stderr, "cannot load the library: error %lu\n", GetLastError());
    return loaded;
}

static function find(library loaded, const char *name) {
    return (function)GetProcAddress(loaded, name);
}
#else
#include <dlfcn.h>

typedef void *library;

static library load(const char *file) {
    library loaded = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    if (!loaded) fprintf(stderr, "cannot load the library: %s\n", dlerror());
    return loaded;
}

static function find(library loaded, const char *name) {
    return (function)dlsym(loaded, name);
}
#endif

typedef void *component;

static void say(void *environment, const char *instance, int status, const char *category, const char *format, ...) {
    va_list arguments;
    (void)environment;
    va_start(arguments, format);
    fprintf(stderr, "%s, %d, %s: ", instance, status, category);
    vfprintf(stderr, format, arguments);
    fprintf(stderr, "\n");
    va_end(arguments);
}

static const struct {
    void (*logger)(void *, const char *, int, const char *, const char *, ...);
    void *(*allocate)(size_t, size_t);
    void (*release)(void *);
    void *step_finished;
    void *environment;
} callbacks = {say, calloc, free, NULL, NULL};

static function function_of(library loaded, const char *name) {
    function found = find(loaded, name);
    if (!found) {
        fprintf(stderr, "there is no %s\n", name);
        exit(2);
    }
    return found;
}

#define CALL(result, name, types) ((result(*) types)function_of(loaded, name))

typedef int (*stepper)(component, double, double, int);

/* A step while the processor rounds up, which must be as ever and stay so. */
static int step_rounding_up(stepper do_step, component c, double from) {
    fesetround(FE_UPWARD);
    feclearexcept(FE_ALL_EXCEPT);
    int status = do_step(c, from, 1e-3, 1);
    if (fegetround() != FE_UPWARD || fetestexcept(FE_ALL_EXCEPT)) {
        fprintf(stderr, "the step leaves another floating-point environment\n");
        status = 3;
    }
    fesetround(FE_TONEAREST);
    return status;
}

int main(int count, char **arguments) {
    library loaded = count > 4 ? load(arguments[1]) : NULL;
    if (!loaded) return 2;
    component c = CALL(component, "fmi2Instantiate", (const char *, int, const char *, const char *, const void *, int, int))(
        "unit", 1, arguments[2], "", &callbacks, 0, 1);
    if (!c) return 1;

    int status = CALL(int, "fmi2SetupExperiment", (component, int, double, double, int, double))(c, 0, 0.0, 0.0, 0, 0.0);
    status |= CALL(int, "fmi2EnterInitializationMode", (component))(c);
    status |= CALL(int, "fmi2ExitInitializationMode", (component))(c);
    unsigned reference = (unsigned)atoi(arguments[3]);
    const double rate = 0.5;
    status |= CALL(int, "fmi2SetReal", (component, const unsigned *, size_t, const double *))(c, &reference, 1, &rate);
    stepper do_step = CALL(int, "fmi2DoStep", (component, double, double, int));
    for (int n = 0; n < 1000; n++) status |= step_rounding_up(do_step, c, n * 1e-3);

    /* An error must come back as such, with its message: nothing may unwind into the host. */
    const double no_number = strtod("nan", NULL);
    int refused = CALL(int, "fmi2SetReal", (component, const unsigned *, size_t, const double *))(c, &reference, 1, &no_number);

    for (int i = 4; i < count; i++) {
        double value = 0.0;
        reference = (unsigned)atoi(arguments[i]);
        status |= CALL(int, "fmi2GetReal", (component, const unsigned *, size_t, double *))(c, &reference, 1, &value);
        printf("%.17g\n", value);
    }
    status |= CALL(int, "fmi2Terminate", (component))(c);
    CALL(void, "fmi2FreeInstance", (component))(c);
    return status == 0 && refused == 3 ? 0 : 1;
}
