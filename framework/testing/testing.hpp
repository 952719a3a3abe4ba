#pragma once
// Everything that a step's tests use.
#include "testing/catch.hpp"
#include "testing/fake_tracer.hpp"
#include "testing/hits.hpp"
#include "testing/matchers.hpp"
#include "testing/random.hpp"
#include "testing/scenes.hpp"
#include "testing/string_makers.hpp"
