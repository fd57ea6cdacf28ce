#include "reprise/io/compression.hpp"

#include <array>
#include <boost/iostreams/device/array.hpp>
#include <boost/iostreams/device/back_inserter.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filtering_stream.hpp>
#include <stdexcept>

namespace reprise {

namespace streams = boost::iostreams;

std::string compress(std::string_view text) {
  std::string compressed;
  {
    streams::filtering_ostream stream;
    stream.push(streams::gzip_compressor(streams::gzip_params(streams::gzip::best_compression)));
    stream.push(streams::back_inserter(compressed));
    stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  }
  return compressed;
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
  if (text.size() > most) throw std::runtime_error("it is longer than " + std::to_string(most) + " bytes");
  return text;
}

}  // namespace reprise
