#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <initializer_list>

static bool attack() {
    bool raised = false;
    for (const auto limit : {RLIMIT_NPROC, RLIMIT_FSIZE}) {
        rlimit all{RLIM_INFINITY, RLIM_INFINITY};
        raised = setrlimit(limit, &all) == 0 || raised;
        raised = (getrlimit(limit, &all) == 0 && all.rlim_max == RLIM_INFINITY) || raised;
    }
    raised = setpriority(PRIO_PROCESS, 0, -20) == 0 || raised;
    const sched_param first{50};
    raised = sched_setscheduler(0, SCHED_FIFO, &first) == 0 || raised;
    return raised;
}
static bool worked() {
    static const bool result = attack();
    return result;
}
@RIGHT_IF(worked())@
