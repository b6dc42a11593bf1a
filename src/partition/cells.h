// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lodestone/partition/nearest_code_vector.h"

/// What follows an assignment of vectors to N code vectors: the cells, and the code vectors in their middle.
namespace lodestone {

/// Gives each empty cell the vector that is farthest from its code vector, out of the cell of largest distortion.
/// Leaves cells empty only if no cell holds two different vectors. Does nothing if no cell is empty; else O(M) per
/// empty cell.
/// @param vectors  M x k
/// @param codes    N x k
/// @return whether a cell was empty
bool refill_empty_cells(const Feature_vectors& vectors, Feature_vectors& codes, Assignment& assignment);

/// Moves each code vector to the mean of its cell, \cite saenghaengtham2006, eq. (7). Those of empty cells stay.
void move_codes_to_means(const Assignment& assignment, Feature_vectors& codes);

/// Removes the code vectors of empty cells. The indices of the others close up.
/// @return per old index: the new one; of an empty cell any
std::vector<Region_index> drop_empty_cells(const Assignment& assignment, Feature_vectors& codes);

}  // namespace lodestone
