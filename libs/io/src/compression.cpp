#include "reprise/io/compression.hpp"

// Inside of the filter GCC 12 sees copies of lengths that cannot occur.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wrestrict"
#endif

#include <fmt/format.h>

#include <array>
#include <boost/iostreams/device/array.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filtering_stream.hpp>
#include <sstream>
#include <stdexcept>

namespace reprise {

namespace streams = boost::iostreams;

std::string compress(std::string_view text) {
  std::ostringstream compressed;
  {
    streams::filtering_ostream stream;
    stream.push(streams::gzip_compressor(streams::gzip_params(streams::gzip::best_compression)));
    stream.push(compressed);
    stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  }
  return compressed.str();
}

std::string decompress(std::string_view compressed, std::size_t most) {
  std::string text;
  try {
    streams::filtering_istream stream;
    stream.push(streams::gzip_decompressor());
    stream.push(streams::array_source(compressed.data(), compressed.size()));
    stream.exceptions(std::ios::badbit);
    std::array<char, 65536> block;
    while (stream.good() && text.size() <= most) {
      stream.read(block.data(), static_cast<std::streamsize>(block.size()));
      text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
    }
  } catch (const std::exception&) {
    throw std::runtime_error("it is not in the format of gzip, or damaged");
  }
  if (text.size() > most) throw std::runtime_error(fmt::format("it is longer than {} bytes", most));
  return text;
}

}  // namespace reprise
