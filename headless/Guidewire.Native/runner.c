/* The runner of the installed package: hands its arguments to the native library beside it that this processor can run.
   A program of its own, and not one per processor: most of a library's size is there once. */
#include <dlfcn.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const int internal_error = 70;

int main(int argc, char **argv)
{
    char path[PATH_MAX];
    const char *library = __builtin_cpu_supports("x86-64-v3") ? "guidewire-x86-64-v3.so" : "guidewire-x86-64.so";
    ssize_t length = readlink("/proc/self/exe", path, sizeof path - 1);
    path[length < 0 ? 0 : length] = 0;
    char *slash = strrchr(path, '/');
    if (slash == NULL || (size_t)(slash + 1 - path) + strlen(library) >= sizeof path)
    {
        fprintf(stderr, "guidewire: the folder of the program is not known, or its name is too long\n");
        return internal_error;
    }
    strcpy(slash + 1, library);
    void *handle = dlopen(path, RTLD_NOW);
    int (*run)(int, char **) = handle == NULL ? NULL : (int (*)(int, char **))dlsym(handle, "guidewire_main");
    if (run == NULL)
    {
        fprintf(stderr, "guidewire: %s\n", dlerror());
        return internal_error;
    }
    return run(argc - 1, argv + 1);
}
