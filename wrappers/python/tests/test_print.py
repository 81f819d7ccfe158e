"""Tests sheets, sheet files, printing, overlays, and checks of prints."""

import pytest

import dotpose


def test_a_sheet_fills_its_page():
    sheet = dotpose.make_sheet()
    # These are the properties of the sheet that `dotpose print -o sheet.png --paper A4` prints
    # (README.md).
    assert (sheet.width_mm, sheet.height_mm, sheet.columns, sheet.rows) == (210, 297, 394, 565)
    assert sheet.spacing_mm == 0.508 and sheet.dot_mm == sheet.displacement_mm == 0.508 / 6
    assert sheet.code == "anoto" and sheet.section == (0, 0) and sheet.origin == (0, 0)
    wide = dotpose.make_sheet("A5", landscape=True, origin=(10, 20), section=(3, 4), code="libdots")
    assert (wide.width_mm, wide.height_mm) == (210, 148)
    assert (wide.origin, wide.section, wide.code) == ((10, 20), (3, 4), "libdots")
    sheets = dotpose.make_sheets(3, "A6")
    assert [sheet.origin[0] for sheet in sheets] == [0, sheets[0].columns, 2 * sheets[0].columns]


@pytest.mark.parametrize(
    "arguments, words",
    [({"paper": "A99"}, "A99"), ({"margin_mm": 200.0}, "margin"), ({"origin": (-1, 0)}, "-1"),
     ({"section": (63, 0)}, "63"), ({"code": "auto"}, "auto"), ({"dot_mm": 1.0}, "dot")],
)
def test_sheets_that_cannot_be_are_a_bad_argument(arguments, words):
    with pytest.raises(dotpose.BadArgument, match=words):
        dotpose.make_sheet(**arguments)


def test_printed_sheets_read_back(tmp_path):
    sheet = dotpose.make_sheet("100x80", origin=(3000, 4000), section=(5, 6))
    written = dotpose.print_sheet(tmp_path / "sheet.png", sheet, dpi=600)
    assert written.origin == (3000, 4000)
    page = dotpose.read_image(tmp_path / "sheet.png")
    assert page.shape == (1890, 2362)
    fix = dotpose.Locator().locate(page)
    # The centre of pixel (0, 0) is half a pixel from the corner of the page.
    middle_mm = (page.shape[1] - 1) / 2 * 25.4 / 600 + 25.4 / 1200
    assert fix.section == (5, 6) and abs(fix.theta_rad) < 1e-4
    assert fix.x_mm == pytest.approx(3000 * 0.508 + middle_mm - sheet.origin_x_mm, abs=0.01)


def test_documents_have_pages(tmp_path):
    sheets = dotpose.make_sheets(2, "A6")
    assert len(dotpose.print_sheets(tmp_path / "two.pdf", sheets, labels=False)) == 2
    assert (tmp_path / "two.pdf").read_bytes().startswith(b"%PDF")
    with pytest.raises(dotpose.BadArgument):
        dotpose.print_sheets(tmp_path / "two.png", sheets)
    with pytest.raises(dotpose.BadArgument, match="gif"):
        dotpose.print_sheet(tmp_path / "sheet.gif")
    with pytest.raises(dotpose.Error, match="none"):
        dotpose.print_sheet(tmp_path / "none" / "sheet.svg")


def test_a_sheet_file_is_saved_at_the_end_of_its_block(tmp_path):
    path = tmp_path / "sheets.json"
    with dotpose.SheetFile(path) as file:
        (table,) = file.allocate("table", dotpose.make_sheet("A5"))
        tiles = file.allocate("tile", dotpose.make_sheet("A6"), 2)
        assert not path.exists()
    assert [entry.name for entry in dotpose.read_sheets(path)] == ["table", "tile-1", "tile-2"]
    assert table.sheet.origin != tiles[0].sheet.origin != tiles[1].sheet.origin
    with dotpose.SheetFile(path) as file:
        table.world = dotpose.WorldPose(1, 2, 0.5)
        table.print_scale_x = 1.01
        file.replace(table)
        file.rename("tile-2", "wall")
        file.remove("tile-1")
        with pytest.raises(dotpose.BadArgument, match="table"):
            file.add(table)
    table, wall = dotpose.read_sheets(path)
    assert wall.name == "wall" and table.world.yaw_rad == 0.5 and table.print_scale_x == 1.01


def test_a_sheet_file_is_unchanged_after_an_exception(tmp_path):
    path = tmp_path / "sheets.json"
    with pytest.raises(KeyError):
        with dotpose.SheetFile(path) as file:
            file.allocate("table", dotpose.make_sheet("A5"))
            raise KeyError
    assert not path.exists()
    with pytest.raises(dotpose.Error, match="with SheetFile"):
        file.sheets
    with dotpose.SheetFile(path) as file:
        with pytest.raises(dotpose.Error, match="sheets.json"):
            with dotpose.SheetFile(path, wait_s=0.1):
                pass


def test_printing_enters_sheets_in_a_file(tmp_path):
    path = tmp_path / "sheets.json"
    first = dotpose.print_sheet(tmp_path / "a.svg", sheet_file=path, name="a")
    second = dotpose.print_sheet(tmp_path / "b.svg", sheet_file=path, name="b")
    assert [(e.name, e.sheet.origin, e.is_reserved) for e in dotpose.read_sheets(path)] == [
        ("a", first.origin, False), ("b", second.origin, False)
    ]
    assert first.origin != second.origin
    with pytest.raises(dotpose.BadArgument, match="together"):
        dotpose.print_sheet(tmp_path / "c.svg", sheet_file=path)
    with pytest.raises(dotpose.Error):
        dotpose.print_sheet(tmp_path / "none" / "c.svg", sheet_file=path, name="c")
    assert len(dotpose.read_sheets(path)) == 2
    with pytest.raises(dotpose.Error, match="broken"):
        (tmp_path / "broken.json").write_text("{")
        dotpose.read_sheets(tmp_path / "broken.json")


def test_dots_over_a_document(tmp_path):
    dotpose.print_sheets(tmp_path / "form.pdf", dotpose.make_sheets(2, "A6"))
    report = dotpose.overlay(
        tmp_path / "form.pdf", tmp_path / "dots.pdf", pages="2", origin=(900, 0),
        sheet_file=tmp_path / "sheets.json", name="form",
    )
    ((number, sheet),) = report.pages
    (entry,) = dotpose.read_sheets(tmp_path / "sheets.json")
    assert number == 2 and entry.name == "form" and entry.sheet.origin == sheet.origin
    assert isinstance(report.warnings, list)
    assert (tmp_path / "dots.pdf").read_bytes().startswith(b"%PDF")
    with pytest.raises(dotpose.Error, match="none.pdf"):
        dotpose.overlay(tmp_path / "none.pdf", tmp_path / "dots.pdf")


def test_a_print_is_checked(tmp_path):
    path = tmp_path / "scan.png"
    dotpose.print_sheet(path, dotpose.make_sheet("A6", origin=(700, 800)), dpi=600)
    check = dotpose.check_print(path)
    (field,) = check.fields
    assert check.is_good and check.code == "anoto" and not check.is_test_page
    assert check.best is None and [f.kind for f in check.findings if f.is_fault] == []
    assert field.origin == (700, 800) and field.missing == 0 and field.bits_wrong == 0
    assert field.scale.scale_x == pytest.approx(1, abs=1e-4)
    assert field.dots == field.cells == field.columns * field.rows
    check.draw(tmp_path / "scan.svg")
    assert "<svg" in (tmp_path / "scan.svg").read_text()
    # If the scan is declared as 580 dpi, the page appears to be printed too large.
    scaled = dotpose.check_print(dotpose.read_image(path), dpi=580)
    assert not scaled.is_good
    assert scaled.fields[0].scale.scale_x == pytest.approx(600 / 580, abs=1e-4)
    assert any(f.is_fault and f.kind == "scaled" and f.text for f in scaled.findings)
    photo = dotpose.check_print(path, is_photo=True)
    assert photo.fields[0].scale is None
