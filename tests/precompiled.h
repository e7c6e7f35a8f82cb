// Headers that most tests include, compiled once for all of them. Files still include what they use.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "framework/precompiled.h"
