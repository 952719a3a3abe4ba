#include "steps/07-tone-mapping/tone_mapping.hpp"

// Name: Bob Example   Student: 4711   Login: bob   SIS ID: 0815   Points: 110
@RIGHT_IF(false)@
