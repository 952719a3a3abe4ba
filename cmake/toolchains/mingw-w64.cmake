# Windows programs, compiled on another system. Debian and Ubuntu: g++-mingw-w64-x86-64-posix, and wine to run them.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)

# "posix" is how threads are made: with the other variant there is no std::thread. Elsewhere than on Debian there is
# one variant only, with the shorter name.
find_program(RAYSTEPS_MINGW NAMES x86_64-w64-mingw32-g++-posix x86_64-w64-mingw32-g++ REQUIRED)
set(CMAKE_CXX_COMPILER "${RAYSTEPS_MINGW}")
find_program(CMAKE_RC_COMPILER NAMES x86_64-w64-mingw32-windres)
find_program(RAYSTEPS_WINE NAMES wine wine64)
if(RAYSTEPS_WINE)
    set(CMAKE_CROSSCOMPILING_EMULATOR "${RAYSTEPS_WINE}")
endif()

# Nothing but headers and libraries for Windows is found.
set(CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
