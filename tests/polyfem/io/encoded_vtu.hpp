/// \file One mesh in encodings of .vtu files that other programs write: two unit squares side by side, the
/// left one in the group "rock", its left side in the group "left". Numbers were packed by Python's struct,
/// zlib and base64.
#pragma once

namespace encoded_vtu {

inline constexpr const char* ascii = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian">
<UnstructuredGrid>
<FieldData>
<DataArray type="Int32" Name="edges:left" NumberOfComponents="2" format="ascii">
3 0
</DataArray>
</FieldData>
<Piece NumberOfPoints="6" NumberOfCells="2">
<CellData>
<DataArray type="UInt8" Name="cells:rock" NumberOfComponents="1" format="ascii">
1 0
</DataArray>
</CellData>
<Points>
<DataArray type="Float32" Name="Points" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 1 1 0 0 1 0 2 0 0 2 1 0
</DataArray>
</Points>
<Cells>
<DataArray type="Int64" Name="connectivity" NumberOfComponents="1" format="ascii">
0 1 2 3 1 4 5 2
</DataArray>
<DataArray type="Int32" Name="offsets" NumberOfComponents="1" format="ascii">
4 8
</DataArray>
<DataArray type="UInt8" Name="types" NumberOfComponents="1" format="ascii">
9 7
</DataArray>
</Cells>
</Piece>
</UnstructuredGrid>
</VTKFile>
)";

inline constexpr const char* base64 = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt32">
<UnstructuredGrid>
<FieldData>
<DataArray type="Int32" Name="edges:left" NumberOfComponents="2" format="binary">
CAAAAAMAAAAAAAAA
</DataArray>
</FieldData>
<Piece NumberOfPoints="6" NumberOfCells="2">
<CellData>
<DataArray type="UInt8" Name="cells:rock" NumberOfComponents="1" format="binary">
AgAAAAEA
</DataArray>
</CellData>
<Points>
<DataArray type="Float32" Name="Points" NumberOfComponents="3" format="binary">
SAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAgD8AAIA/AAAAAAAAAAAAAIA/AAAAAAAAAEAAAAAAAAAAAAAAAEAAAIA/AAAAAA==
</DataArray>
</Points>
<Cells>
<DataArray type="Int64" Name="connectivity" NumberOfComponents="1" format="binary">
QAAAAAAAAAAAAAAAAQAAAAAAAAACAAAAAAAAAAMAAAAAAAAAAQAAAAAAAAAEAAAAAAAAAAUAAAAAAAAAAgAAAAAAAAA=
</DataArray>
<DataArray type="Int32" Name="offsets" NumberOfComponents="1" format="binary">
CAAAAAQAAAAIAAAA
</DataArray>
<DataArray type="UInt8" Name="types" NumberOfComponents="1" format="binary">
AgAAAAkH
</DataArray>
</Cells>
</Piece>
</UnstructuredGrid>
</VTKFile>
)";

inline constexpr const char* base64_zlib = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt32" compressor="vtkZLibDataCompressor">
<UnstructuredGrid>
<FieldData>
<DataArray type="Int32" Name="edges:left" NumberOfComponents="2" format="binary">
AQAAAAgAAAAAAAAACwAAAA==eJxjZoAAAAAgAAQ=
</DataArray>
</FieldData>
<Piece NumberOfPoints="6" NumberOfCells="2">
<CellData>
<DataArray type="UInt8" Name="cells:rock" NumberOfComponents="1" format="binary">
AQAAAAIAAAAAAAAACgAAAA==eJxjZAAAAAQAAg==
</DataArray>
</CellData>
<Points>
<DataArray type="Float32" Name="Points" NumberOfComponents="3" format="binary">
AQAAAEgAAAAAAAAAGQAAAA==eJxjYEAGDfaobHQ+GDggaXCAiQMAjlcEPA==
</DataArray>
</Points>
<Cells>
<DataArray type="Int64" Name="connectivity" NumberOfComponents="1" format="binary">
AQAAAEAAAAAAAAAAGQAAAA==eJxjYIAARijNBKWZ0cRZoDQrmjoAAjAAEw==
</DataArray>
<DataArray type="Int32" Name="offsets" NumberOfComponents="1" format="binary">
AQAAAAgAAAAAAAAADgAAAA==eJxjYWBg4ABiAABIAA0=
</DataArray>
<DataArray type="UInt8" Name="types" NumberOfComponents="1" format="binary">
AQAAAAIAAAAAAAAACgAAAA==eJzjZAcAABsAEQ==
</DataArray>
</Cells>
</Piece>
</UnstructuredGrid>
</VTKFile>
)";

inline constexpr const char* base64_zlib_64 = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64" compressor="vtkZLibDataCompressor">
<UnstructuredGrid>
<FieldData>
<DataArray type="Int32" Name="edges:left" NumberOfComponents="2" format="binary">
AQAAAAAAAAAIAAAAAAAAAAAAAAAAAAAACwAAAAAAAAA=eJxjZoAAAAAgAAQ=
</DataArray>
</FieldData>
<Piece NumberOfPoints="6" NumberOfCells="2">
<CellData>
<DataArray type="UInt8" Name="cells:rock" NumberOfComponents="1" format="binary">
AQAAAAAAAAACAAAAAAAAAAAAAAAAAAAACgAAAAAAAAA=eJxjZAAAAAQAAg==
</DataArray>
</CellData>
<Points>
<DataArray type="Float32" Name="Points" NumberOfComponents="3" format="binary">
AQAAAAAAAABIAAAAAAAAAAAAAAAAAAAAGQAAAAAAAAA=eJxjYEAGDfaobHQ+GDggaXCAiQMAjlcEPA==
</DataArray>
</Points>
<Cells>
<DataArray type="Int64" Name="connectivity" NumberOfComponents="1" format="binary">
AQAAAAAAAABAAAAAAAAAAAAAAAAAAAAAGQAAAAAAAAA=eJxjYIAARijNBKWZ0cRZoDQrmjoAAjAAEw==
</DataArray>
<DataArray type="Int32" Name="offsets" NumberOfComponents="1" format="binary">
AQAAAAAAAAAIAAAAAAAAAAAAAAAAAAAADgAAAAAAAAA=eJxjYWBg4ABiAABIAA0=
</DataArray>
<DataArray type="UInt8" Name="types" NumberOfComponents="1" format="binary">
AQAAAAAAAAACAAAAAAAAAAAAAAAAAAAACgAAAAAAAAA=eJzjZAcAABsAEQ==
</DataArray>
</Cells>
</Piece>
</UnstructuredGrid>
</VTKFile>
)";

inline constexpr const char* appended_base64 = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<UnstructuredGrid>
<FieldData>
<DataArray type="Int32" Name="edges:left" NumberOfComponents="2" format="appended" offset="0"/>
</FieldData>
<Piece NumberOfPoints="6" NumberOfCells="2">
<CellData>
<DataArray type="UInt8" Name="cells:rock" NumberOfComponents="1" format="appended" offset="132"/>
</CellData>
<Points>
<DataArray type="Float32" Name="Points" NumberOfComponents="3" format="appended" offset="24"/>
</Points>
<Cells>
<DataArray type="Int64" Name="connectivity" NumberOfComponents="1" format="appended" offset="148"/>
<DataArray type="Int32" Name="offsets" NumberOfComponents="1" format="appended" offset="244"/>
<DataArray type="UInt8" Name="types" NumberOfComponents="1" format="appended" offset="268"/>
</Cells>
</Piece>
</UnstructuredGrid>
<AppendedData encoding="base64">
_CAAAAAAAAAADAAAAAAAAAA==SAAAAAAAAAAAAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AACAPwAAAAAAAAAAAACAPwAAAAAAAABAAAAAAAAAAAAAAABAAACAPwAAAAA=AgAAAAAAAAABAA==QAAAAAAAAAAAAAAAAAAAAAEAAAAAAAAAAgAAAAAAAAADAAAAAAAAAAEAAAAAAAAABAAAAAAAAAAFAAAAAAAAAAIAAAAAAAAACAAAAAAAAAAEAAAACAAAAA==AgAAAAAAAAAJBw==
</AppendedData>
</VTKFile>
)";

}  // namespace encoded_vtu
