#include "@KIT@/solutions/07-tone-mapping/tone_mapping.cpp"
