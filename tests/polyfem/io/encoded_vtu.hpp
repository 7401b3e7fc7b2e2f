/// \file One mesh in encodings of .vtu files that other programs write: two unit squares side by side, the
/// left one in the group "rock", its left side in the group "left". Numbers were packed by Python's struct,
/// zlib and base64.
#pragma once

#include <array>
#include <string>

namespace encoded_vtu {

/// The file with these attributes of its root and its six arrays: edges, groups of cells, points,
/// connectivity, offsets, types. Arrays that stand behind the cells, as `appended`, are places there.
inline std::string file(const std::string& root, const std::string& format,
                        const std::array<std::string, 6>& arrays, const std::string& appended = "") {
  const char* const head[] = {"Int32\" Name=\"edges:left\" NumberOfComponents=\"2",
                              "UInt8\" Name=\"cells:rock\" NumberOfComponents=\"1",
                              "Float32\" Name=\"Points\" NumberOfComponents=\"3",
                              "Int64\" Name=\"connectivity\" NumberOfComponents=\"1",
                              "Int32\" Name=\"offsets\" NumberOfComponents=\"1",
                              "UInt8\" Name=\"types\" NumberOfComponents=\"1"};
  const auto array = [&](int k) {
    const std::string start = "<DataArray type=\"" + std::string(head[k]) + "\" format=\"" + format + "\"";
    return appended.empty() ? start + ">\n" + arrays[k] + "\n</DataArray>\n"
                            : start + " offset=\"" + arrays[k] + "\"/>\n";
  };
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
         "byte_order=\"LittleEndian\"" +
         root + ">\n<UnstructuredGrid>\n<FieldData>\n" + array(0) +
         "</FieldData>\n<Piece NumberOfPoints=\"6\" NumberOfCells=\"2\">\n<CellData>\n" + array(1) +
         "</CellData>\n<Points>\n" + array(2) + "</Points>\n<Cells>\n" + array(3) + array(4) + array(5) +
         "</Cells>\n</Piece>\n</UnstructuredGrid>\n" +
         (appended.empty() ? ""
                           : "<AppendedData encoding=\"base64\">\n_" + appended + "\n</AppendedData>\n") +
         "</VTKFile>\n";
}

inline const std::string ascii =
    file("", "ascii", {"3 0", "1 0", "0 0 0 1 0 0 1 1 0 0 1 0 2 0 0 2 1 0", "0 1 2 3 1 4 5 2", "4 8", "9 7"});
inline const std::string base64 =
    file(" header_type=\"UInt32\"", "binary",
         {"CAAAAAMAAAAAAAAA", "AgAAAAEA",
          "SAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAgD8AAIA/AAAAAAAAAAAAAIA/AAAAAAAAAEAAAAAAAAAAAAAAAEAAAIA/"
          "AAAAAA==",
          "QAAAAAAAAAAAAAAAAQAAAAAAAAACAAAAAAAAAAMAAAAAAAAAAQAAAAAAAAAEAAAAAAAAAAUAAAAAAAAAAgAAAAAAAAA=",
          "CAAAAAQAAAAIAAAA", "AgAAAAkH"});
inline const std::string base64_zlib =
    file(" header_type=\"UInt32\" compressor=\"vtkZLibDataCompressor\"", "binary",
         {"AQAAAAgAAAAAAAAACwAAAA==eJxjZoAAAAAgAAQ=", "AQAAAAIAAAAAAAAACgAAAA==eJxjZAAAAAQAAg==",
          "AQAAAEgAAAAAAAAAGQAAAA==eJxjYEAGDfaobHQ+GDggaXCAiQMAjlcEPA==",
          "AQAAAEAAAAAAAAAAGQAAAA==eJxjYIAARijNBKWZ0cRZoDQrmjoAAjAAEw==",
          "AQAAAAgAAAAAAAAADgAAAA==eJxjYWBg4ABiAABIAA0=", "AQAAAAIAAAAAAAAACgAAAA==eJzjZAcAABsAEQ=="});
inline const std::string base64_zlib_64 =
    file(" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\"", "binary",
         {"AQAAAAAAAAAIAAAAAAAAAAAAAAAAAAAACwAAAAAAAAA=eJxjZoAAAAAgAAQ=",
          "AQAAAAAAAAACAAAAAAAAAAAAAAAAAAAACgAAAAAAAAA=eJxjZAAAAAQAAg==",
          "AQAAAAAAAABIAAAAAAAAAAAAAAAAAAAAGQAAAAAAAAA=eJxjYEAGDfaobHQ+GDggaXCAiQMAjlcEPA==",
          "AQAAAAAAAABAAAAAAAAAAAAAAAAAAAAAGQAAAAAAAAA=eJxjYIAARijNBKWZ0cRZoDQrmjoAAjAAEw==",
          "AQAAAAAAAAAIAAAAAAAAAAAAAAAAAAAADgAAAAAAAAA=eJxjYWBg4ABiAABIAA0=",
          "AQAAAAAAAAACAAAAAAAAAAAAAAAAAAAACgAAAAAAAAA=eJzjZAcAABsAEQ=="});
inline const std::string appended_base64 =
    file(" header_type=\"UInt64\"", "appended", {"0", "132", "24", "148", "244", "268"},
         "CAAAAAAAAAADAAAAAAAAAA==SAAAAAAAAAAAAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/"
         "AACAPwAAAAAAAAAAAACAPwAAAAAAAABAAAAAAAAAAAAAAABAAACAPwAAAAA=AgAAAAAAAAABAA=="
         "QAAAAAAAAAAAAAAAAAAAAAEAAAAAAAAAAgAAAAAAAAADAAAAAAAAAAEAAAAAAAAABAAAAAAAAAAFAAAAAAAAAAIAAAAAAAAACAA"
         "AAAAAAAAEAAAACAAAAA==AgAAAAAAAAAJBw==");

}  // namespace encoded_vtu
