// Loads the plug-in named, lets it draw, unloads it, twice. Exit status 0 when nothing of it stays behind.

#include <dlfcn.h>

#include <cstdio>

namespace {

int failed(const char* what) {
    std::fprintf(stderr, "engine_with_plugin: %s\n", what);
    return 1;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return failed("usage: engine_with_plugin plugin.so");
    for (int round = 0; round < 2; ++round) {
        void* plugin = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
        if (plugin == nullptr) return failed(dlerror());
        const auto draws = reinterpret_cast<bool (*)()>(dlsym(plugin, "draws"));
        if (draws == nullptr || !draws()) return failed("the plug-in does not draw");
        if (dlclose(plugin) != 0) return failed(dlerror());
        if (dlopen(argv[1], RTLD_NOW | RTLD_NOLOAD) != nullptr) return failed("the plug-in is still there");
    }
    return 0;
}
