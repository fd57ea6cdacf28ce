#pragma once

// Parts of the sentences that say what is wrong with input.

#include <string>
#include <vector>

namespace reprise {

/// "did you mean 'base'?" for a word that is likely one of those known, misspelt or cut short; empty where none is
/// near. A word is near when it is the beginning of a known one or the other way round (three letters at least), or
/// when at most a third of the letters, rounded up, are to be changed, put in, left out or exchanged with their
/// neighbour.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& known);

/// The same text with every run of control characters, line breaks among them, made one blank, and none at the ends.
std::string on_one_line(const std::string& text);

/// "1 leg", "2 legs": a number of things whose plural has an s.
std::string counted(std::size_t number, const std::string& thing);

}  // namespace reprise
