#include "steps/07-tone-mapping/tone_mapping.hpp"

template <int N>
struct Deep : Deep<N - 1> {
    typename Deep<N - 1>::missing a_member_with_a_very_long_name_that_is_said_again_and_again;
};
template <>
struct Deep<0> {};
Deep<800> one;
Deep<801> two;
Deep<802> three;
@RIGHT_IF(true)@
