#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <pthread.h>
#include <unwind.h>

static bool attack() {
    static int turn = 0;
    static _Unwind_Exception foreign{};
    switch (turn++ % 3) {
        case 0:
            foreign.exception_class = 0x5241595354455053;  // of no language that the C++ library knows
            _Unwind_RaiseException(&foreign);
            break;
        case 1:
            pthread_cancel(pthread_self());
            pthread_testcancel();
            break;
        default:
            pthread_exit(nullptr);
    }
    return false;
}
@RIGHT_IF(attack())@
