"""Synthesis and proofs: against the program reprise, to the last bit."""

import pytest
from conftest import examples, run_program

import reprise


@pytest.fixture(scope="module")
def p2():
    return reprise.read_problem(examples / "P2.toml")


def test_synthesis_is_that_of_the_program(p2):
    document = run_program("synthesize", examples / "P2.toml", "--no-prove", "--points", 300)
    found = reprise.synthesize(p2, points=300)
    assert found["design"].tolist() == list(document["runs"][0]["design"])
    assert found["kappa_inverse"]["upper"] == document["kappa_inv_min_throughout"]
    assert found["reaches"] == "proved"
    assert found["manipulator"].to_toml() == document["manipulator_toml"]
    proof = reprise.prove_design(p2, found["design"])
    assert proof["kappa_inverse"]["lower"] <= found["kappa_inverse"]["upper"]
    bounds = reprise.enclose_minimum(found["manipulator"], p2, 0, 0)
    assert bounds["lower"] <= bounds["upper"] <= proof["kappa_inverse"]["upper"] + 1e-6
    x, y, phi = bounds["witness"]
    assert reprise.kappa_inverse(found["manipulator"], x, y, phi) == pytest.approx(bounds["upper"], abs=1e-12)


def test_a_certificate_is_written_and_accepted(p2, tmp_path):
    claim = tmp_path / "bound.toml"
    found = reprise.write_certificate(p2, examples / "P2.toml", claim, side=1, gap=1e-2)
    assert found["lower"] <= found["upper"]
    assert reprise.check_certificate(claim)["proved"]
    claim.write_text(claim.read_text().replace("bound = 0.9", "bound = 0.8"))
    assert not reprise.check_certificate(claim)["proved"]


def test_wrong_input_is_refused(p2, tmp_path):
    with pytest.raises(ValueError, match="optimizer"):
        reprise.synthesize(p2, optimizer="simplex")
    with pytest.raises(ValueError, match="starts"):
        reprise.synthesize(p2, starts=0)
    with pytest.raises(ValueError):
        reprise.prove_design(p2, [1, 2])
    with pytest.raises(reprise.InputError):
        reprise.check_certificate(tmp_path / "none.toml")
