// Which earlier columns tell how a column turns.
#pragma once

#include <vector>

#include "exact/adaptive_prediction.h"
#include "exact/number_table.h"

namespace reprise {

/// References of each column, those that save more than they cost. Of what is found with
/// floating-point numbers only the choice is stored.
std::vector<ColumnReferences> find_references(const NumberTable& table);

}  // namespace reprise
