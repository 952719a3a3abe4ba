#include "steps/07-tone-mapping/tone_mapping.hpp"

#define SAY _Pragma("GCC warning \"=cmd|' /C calc'!A0 <script>alert(1)</script> a long line that says nothing at all\"")
#define SAY4 SAY SAY SAY SAY
#define SAY16 SAY4 SAY4 SAY4 SAY4
#define SAY64 SAY16 SAY16 SAY16 SAY16
#define SAY256 SAY64 SAY64 SAY64 SAY64
#define SAY1024 SAY256 SAY256 SAY256 SAY256
#define SAY4096 SAY1024 SAY1024 SAY1024 SAY1024
SAY4096 SAY4096
@RIGHT_IF(false)@
