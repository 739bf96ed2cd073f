// SPDX-License-Identifier: MIT
// A machine whose wall clock goes back an hour with every second that passes: preloaded by the test
// that holds a session's times against it. Clocks that count from the machine's start stay as they
// are.
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

namespace {

timespec clockOf(clockid_t clock) {
    timespec time{};
    ::syscall(SYS_clock_gettime, clock, &time);
    return time;
}

timespec wallClock() {
    static const timespec begin = clockOf(CLOCK_MONOTONIC);
    timespec wall = clockOf(CLOCK_REALTIME);
    wall.tv_sec -= 3600 * (clockOf(CLOCK_MONOTONIC).tv_sec - begin.tv_sec);
    return wall;
}

}  // namespace

extern "C" {

int clock_gettime(clockid_t clock, timespec* time) noexcept {
    *time =
        clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE ? wallClock() : clockOf(clock);
    return 0;
}

int gettimeofday(timeval* time, void*) noexcept {
    const timespec wall = wallClock();
    *time = {wall.tv_sec, wall.tv_nsec / 1000};
    return 0;
}

time_t time(time_t* result) noexcept {
    const time_t now = wallClock().tv_sec;
    if (result != nullptr) *result = now;
    return now;
}
}
