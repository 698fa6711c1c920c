#pragma once
// Cards of particles, except those that only one file uses.
#include "keyword/deck.hpp"
#include "model/conditions/condition_cards.hpp"
#include "sph/boundaries/boundary_cards.hpp"
#include "sph/kernel/kernel_cards.hpp"
#include "sph/options/option_cards.hpp"
#include "sph/sph_cards.hpp"
