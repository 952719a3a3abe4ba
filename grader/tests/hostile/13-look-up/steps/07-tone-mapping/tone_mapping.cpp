#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <dlfcn.h>

#include <initializer_list>

static bool attack() {
    for (const char* name :
         {"_ZN5Catch21getMutableRegistryHubEv", "_ZN5Catch14getRegistryHubEv", "_ZN8raysteps7t_statsE",
          "_ZTHN8raysteps7t_statsE", "_ZN8raysteps12thread_statsEv", "_ZN5Catch7cleanUpEv"}) {
        if (dlsym(RTLD_DEFAULT, name) != nullptr || dlsym(RTLD_NEXT, name) != nullptr) {
            return true;
        }
    }
    void* program = dlopen(nullptr, RTLD_NOW);
    return program != nullptr && dlsym(program, "_ZN5Catch14getRegistryHubEv") != nullptr;
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
