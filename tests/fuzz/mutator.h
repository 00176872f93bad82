#pragma once
/// Changes texts as people, loggers and attackers do: numbers, words, lines and brackets, beside single bytes.

#include <boost/random/mersenne_twister.hpp>
#include <string>
#include <vector>

namespace rollrig::fuzz {

using Engine = boost::random::mt19937_64;

/// `input` with one to eight changes, at most `most_bytes` long. `other` is another input of the same reader, from
/// which parts may be taken.
std::string mutate(const std::string& input, const std::string& other, std::size_t most_bytes, Engine& engine);

}  // namespace rollrig::fuzz
