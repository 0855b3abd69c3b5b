"""Tests of lessons: a teacher's session that pupils follow, questions, and the pupils' answers."""

import json

import daemon

STILL = {"image": {"width": 32, "height": 18}}
PUPIL, OTHER = "0123456789abcdef", "fedcba9876543210"
QUESTION = {"text": "Larger or smaller?", "choices": ["larger", "smaller"], "right": 1}


class Lessons(daemon.Case):
    options = ("--sessions", 40, "--client-share", 75)

    def setUp(self):
        super().setUp()
        self.session = self.daemon.post("/v1/sessions", STILL).json()
        self.opened = []

    def tearDown(self):
        for one in self.opened:
            self.daemon.request("DELETE", "/v1/lessons/" + one["id"], headers=self.owner(one))
        self.daemon.request("DELETE", "/v1/sessions/" + self.session["id"], headers=self.owner(self.session))
        super().tearDown()

    def owner(self, one):
        return {"Authorization": "Bearer " + one["token"]}

    def begin(self, **more):
        answer = self.daemon.post("/v1/lessons", {"session": self.session["id"], **more})
        self.assertEqual(answer.status, 201, answer.body)
        self.opened.append(answer.json())
        return self.opened[-1]

    def change(self, one, body, headers=None):
        return self.daemon.request(
            "PATCH",
            "/v1/lessons/" + one["id"],
            json.dumps(body),
            {"Content-Type": "application/json", **(self.owner(one) if headers is None else headers)},
        )

    def hand(self, one, pupil=PUPIL, **more):
        return self.daemon.post(f"/v1/lessons/{one['id']}/hands", {"pupil": pupil, **more})

    def seen(self, one, **headers):
        return self.daemon.get("/v1/lessons/" + one["id"], **headers).json()

    def test_a_lesson_names_its_session(self):
        one = self.begin(link="preset=jet", about="A hole — and a jet")
        self.assertEqual(len(one["token"]), 32)
        told = self.seen(one)
        self.assertEqual(
            told,
            {
                "id": one["id"],
                "session": self.session["id"],
                "link": "preset=jet",
                "about": "A hole — and a jet",
                "lang": "en",
                "pupils": 0,
                "question": None,
            },
        )
        frame = self.daemon.get(f"/v1/sessions/{told['session']}/frame?after=0")
        self.assertEqual(frame.status, 200)

    def test_the_language_of_a_lesson(self):
        one = self.begin(lang="it")
        self.assertEqual(self.hand(one).json()["lang"], "it")
        for lang in "fr", "pt-BR", "zh-Hant-TW", "ast", "abcdefgh-1-12345678":
            self.assertEqual(self.change(one, {"lang": lang}).json()["lang"], lang)
        for lang in (
            "",
            "e",
            "x-y",
            "en-",
            "en--GB",
            "en_GB",
            "english-a1b2c3d4e",
            "abcdefghi",
            "1a",
            "en-" + 4 * "a1234567-" + "a",
            3,
        ):
            problem = self.assertProblem(self.change(one, {"lang": lang}), 422, "invalid-parameters")
            self.assertEqual(problem["pointer"], "/lang")
            self.assertIn("it must be a language tag, such as en or pt-BR", problem["detail"])
        self.assertEqual(self.seen(one)["lang"], "abcdefgh-1-12345678")

    def test_who_may_take_a_copy(self):
        """Without access tokens anybody may take a copy. tests/web/lesson.py tests the roles."""
        one = self.begin()
        self.assertIs(self.hand(one).json()["copies"], True)
        self.assertNotIn("copies", self.seen(one))

    def test_the_address_of_a_new_lesson(self):
        answer = self.daemon.post("/v1/lessons", {"session": self.session["id"]})
        self.opened.append(answer.json())
        self.assertEqual(answer.location(), "/v1/lessons/" + answer.json()["id"])

    def test_the_teacher_moves_to_another_session(self):
        one = self.begin()
        other = self.daemon.post("/v1/sessions", STILL).json()
        self.assertEqual(self.change(one, {"session": other["id"], "link": "time=4"}).status, 200)
        told = self.seen(one)
        self.assertEqual((told["session"], told["link"]), (other["id"], "time=4"))
        self.daemon.request("DELETE", "/v1/sessions/" + other["id"], headers=self.owner(other))
        self.assertEqual(self.seen(one)["session"], other["id"], "the lesson outlives its session")

    def test_who_predicted_what(self):
        one = self.begin()
        self.assertEqual(self.hand(one).json()["choice"], None)
        self.change(one, {"question": QUESTION})
        told = self.hand(one, name="Ada").json()
        self.assertEqual(told["pupils"], 1)
        question = told["question"]
        self.assertEqual((question["number"], question["open"], question["choices"]), (1, True, ["larger", "smaller"]))
        self.assertNotIn("right", question, "pupils do not see the answer yet")
        self.assertNotIn("tally", question)
        self.assertEqual(self.hand(one, question=1, choice=0).json()["choice"], 0)
        self.assertEqual(self.hand(one, question=1, choice=1).json()["choice"], 1, "a choice can be changed")
        self.hand(one, OTHER, name="Émilie", question=1, choice=0)
        told = self.seen(one, **self.owner(one))
        self.assertEqual((told["question"]["answered"], told["question"]["tally"]), (2, [1, 1]))
        self.assertEqual(sorted((hand["name"], hand["choice"]) for hand in told["hands"]), [("Ada", 1), ("Émilie", 0)])
        self.assertNotIn("hands", self.seen(one), "names are for the teacher only")
        self.assertNotIn("hands", self.hand(one).json())

    def test_a_closed_question_shows_its_answer(self):
        one = self.begin()
        self.change(one, {"question": QUESTION})
        self.hand(one, question=1, choice=1)
        self.change(one, {"open": False})
        question = self.hand(one).json()["question"]
        self.assertEqual((question["open"], question["right"], question["tally"]), (False, 1, [0, 1]))
        late = self.assertProblem(self.hand(one, OTHER, question=1, choice=0), 409, "conflict")
        self.assertEqual(late["pointer"], "/question")
        self.change(one, {"question": {**QUESTION, "right": None}})
        again = self.hand(one).json()
        self.assertEqual((again["question"]["number"], again["choice"], again["question"]["answered"]), (2, None, 0))
        self.assertProblem(self.hand(one, question=1, choice=0), 409, "conflict")
        self.change(one, {"question": None})
        self.assertIsNone(self.hand(one).json()["question"])
        self.change(one, {"open": True})
        self.assertProblem(self.hand(one, question=2, choice=0), 409, "conflict")

    def test_the_token(self):
        one = self.begin()
        for headers in {}, {"Authorization": "Bearer " + self.session["token"]}:
            self.assertProblem(self.change(one, {"open": True}, headers), 403, "forbidden")
            gone = self.daemon.request("DELETE", "/v1/lessons/" + one["id"], headers=headers)
            self.assertProblem(gone, 403, "forbidden")
        self.assertEqual(self.daemon.request("DELETE", "/v1/lessons/" + one["id"], headers=self.owner(one)).status, 204)
        for answer in self.daemon.get("/v1/lessons/" + one["id"]), self.hand(one), self.change(one, {}):
            self.assertProblem(answer, 404, "not-found")

    def test_refusals(self):
        one = self.begin()
        self.change(one, {"question": QUESTION})
        many = [str(i) for i in range(7)]
        for body, pointer, words in (
            ({"session": "0" * 16}, "/session", "session is 0000000000000000; it must be the id of an open session"),
            ({"session": 4}, "/session", "session is 4; it must be 16 hexadecimal digits"),
            ({"link": "x" * 8001}, "/link", "it must be a text of 0 to 8000 characters without control characters"),
            ({"about": "a\nb"}, "/about", "without control characters"),
            ({"open": 1}, "/open", "open is 1; it must be true or false"),
            ({"open": True, "opened": 1}, "/opened", "there is no field opened here; did you mean open?"),
            ({"question": 3}, "/question", "it must be an object with text and choices, or null"),
            ({"question": {"choices": ["a", "b"]}}, "/question", "question.text is missing; it must be a text"),
            ({"question": {**QUESTION, "text": 601 * "è"}}, "/question/text", "a text of 1 to 600 characters"),
            ({"question": {"text": "x"}}, "/question", "question.choices is missing; it must be a list"),
            ({"question": {**QUESTION, "choices": ["a"]}}, "/question/choices", "a list of 2 to 6 choices"),
            ({"question": {**QUESTION, "choices": many}}, "/question/choices", "a list of 2 to 6 choices"),
            (
                {"question": {**QUESTION, "choices": ["a", ""]}},
                "/question/choices/1",
                'question.choices.1 is ""; it must be a text of 1 to 200',
            ),
            ({"question": {**QUESTION, "right": 2}}, "/question/right", "question.right is 2; it must be 0 to 1"),
            ({"question": {**QUESTION, "right": 0.5}}, "/question/right", "a whole number from 0 to 5"),
        ):
            with self.subTest(body=body):
                problem = self.assertProblem(self.change(one, body), 422, "invalid-parameters")
                self.assertEqual(problem["pointer"], pointer)
                self.assertIn(words, problem["detail"])
        self.assertEqual(self.seen(one)["question"]["number"], 1, "a refused change has no effect")
        for body, pointer in (
            ({}, "/pupil"),
            ({"pupil": "0123456789ABCDEF"}, "/pupil"),
            ({"pupil": PUPIL, "choice": 0}, "/question"),
            ({"pupil": PUPIL, "question": 1}, "/choice"),
            ({"pupil": PUPIL, "question": 1, "choice": 2}, "/choice"),
            ({"pupil": PUPIL, "question": 1, "choice": -1}, "/choice"),
            ({"pupil": PUPIL, "name": 81 * "x"}, "/name"),
        ):
            with self.subTest(body=body):
                answer = self.daemon.post(f"/v1/lessons/{one['id']}/hands", body)
                self.assertEqual(self.assertProblem(answer, 422, "invalid-parameters")["pointer"], pointer)
        self.assertEqual(
            self.assertProblem(self.daemon.post("/v1/lessons", {}), 422, "invalid-parameters")["pointer"], "/session"
        )
        self.assertProblem(self.daemon.post("/v1/lessons", "[]"), 400, "malformed-json")
        twice = f'{{"session": "{self.session["id"]}", "open": true, "open": true}}'
        self.assertEqual(self.assertProblem(self.daemon.post("/v1/lessons", twice), 422)["pointer"], "/open")

    def test_texts_are_counted_in_characters(self):
        one = self.begin(link=8000 * "è", about=1000 * "€")
        question = {"text": 600 * "è", "choices": [200 * "𝄞", "b"]}
        self.assertEqual(self.change(one, {"question": question}).status, 200)
        self.assertEqual(self.hand(one, name=80 * "𝄞").status, 200)
        told = self.seen(one, **self.owner(one))
        self.assertEqual((told["question"]["text"], told["question"]["choices"][0]), (600 * "è", 200 * "𝄞"))
        self.assertEqual((told["link"], told["about"], told["hands"][0]["name"]), (8000 * "è", 1000 * "€", 80 * "𝄞"))

    def test_limits(self):
        """One client may use three quarters of the 16 lessons. A lesson may have 64 pupils."""
        for _ in range(12):
            self.begin()
        problem = self.assertProblem(self.daemon.post("/v1/lessons", {"session": self.session["id"]}), 429, "quota")
        self.assertEqual(problem["detail"], "you have too many open lessons (limit 12 for one client)")
        one = self.opened[0]
        for n in range(64):
            self.assertEqual(self.hand(one, f"{n:016x}").status, 200)
        self.assertEqual(self.seen(one)["pupils"], 64)
        self.assertEqual(self.assertProblem(self.hand(one, "f" * 16), 409, "conflict")["pointer"], "/pupil")
        self.assertEqual(self.hand(one, f"{3:016x}").status, 200, "one who is there already is served")


if __name__ == "__main__":
    daemon.main()
