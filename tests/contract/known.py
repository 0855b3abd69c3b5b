"""Failures of schemathesis' checks that lie in the protocol: each for some operations, one check and what the answer says, with the reason. All else fails the run."""
import re

# Refusals of a field by itself, of one that is missing or not known: these the document must tell, and a case that fits it must not meet them.
ALONE = [re.compile(sentence) for sentence in (
    r'^[\w./]+ is [^,;]*(, a string where a number is wanted)?, allowed (is|are) ', r'unknown field', r'there is no (field|preset|such)', r'is missing', r'is given twice', r'is no (number|value|field)',
    r'has \d+ \w+, allowed', r'not valid JSON', r'allowed is an? (array|object|list)',
)]
# What JSON Schema and OpenAPI cannot say: a value is sound by itself, and not beside another one. Sentences of refusals, of operations whose name matches, that read like those of a field by itself.
TOGETHER = [
    (r'(POST|GET) /v1/(render|pixel|plan|sessions|jobs|playground|visibility|spectrum)|PATCH /v1/(sessions|playground)', (
        r'^[a-z_.0-9]+ is .*, allowed (is|are|where|with)\b.* (unless|but|in the|without|with|where|when|beside|than|has|have|is) ',  # another field decides what is allowed
        r' M, allowed is (more than|at least|less than|above) .*(horizon|ISCO)',
        r'allowed are .*there is no such asset|there is no such asset here',
        r', (it|which) needs ', r'; it needs ', r'allowed is less than [a-z_.]+', r'allowed is more than [a-z_.]+', r'^image\.tile\.\w+ is ', r'^look_at is', r'is given with ', r' with camera\.', r'allowed is at least camera\.r', r'microarcseconds, allowed are up to', r'^[\w.]+ is a (picture|grid) of ', r'allowed is .*the playground\'s', r' of \w+ and \w+', r'^(first|stride|count) is .* particles',
        r'which is no SHA-256, and no name of an asset',  # an asset has to be there
    )),
    (r'POST /v1/(line|transfer-function|spectrum|visibility)', (
        r"within the ISCO of this spin", r'^outer is .* and inner is', r'^(energy|frequency)_max\w* is .* and \w+_min\w* ', r'is given, and belongs to ', r'is given beside ', r'^u has .* and v has',
        r'^there is no field \w+ here', r'has no light of one frequency in physical units', r'^nothing shines in the picture', r'one number, allowed are', r' are more than ', r'was not found', r'accuracy\.orders of the scene', r'times the horizon of this spin', r', from inner to outer', r'allowed are larger (radii|values|numbers)',
    )),
    (r'POST /v1/orbits', (r'is missing: whence', r'without periods', r'of an orbit that is seen', r'horizon', r'separatrix', r'innermost', r'no such orbit', r'there is no .*orbit')),
    (r'POST /v1/rays', (r'^the query may hold parameters beside a body of application/x-npy only', r'horizon')),  # OpenAPI's parameters are those of all bodies of an operation
    (r'GET /v1/physics/', (
        r'horizon', r'^\w+ is \'[^\']*:[^\']*\', allowed are', r'or a range first:last:count',  # a range is text, whose numbers a pattern cannot bound
        r', and \w+ is ', r'allowed is (more|less) than ', r'not outside ', r'nothing of this holds', r'turns outside', r'with which it ', r'one of them must be given',
    )),
    # The values of an axis are those of its field, whose schema depends on the name that the axis has.
    (r'POST /v1/(jobs|sessions/.*/path)', (r'^keyframes/\d+/(frame|at) is',)),  # each behind the one before it
    (r'POST /v1/(jobs|plan)', (r'^axes?\b', r'axis', r'a range that leads from its start to its stop', r'^exposure is of pictures', r'is no (number|value|field)')),
    (r'POST /v1/playground|POST /v1/jobs', (r'^\w+ is no number', r'^velocity is .* c, allowed is up to c')),  # in all three directions together;  # state of a snapshot is to be given back as it came: nobody else can make one
]
RULES = [(re.compile(operation), [re.compile(sentence) for sentence in sentences]) for operation, sentences in TOGETHER]



def is_together(label, sentence):
    """Whether a refusal is of values that do not go together, or of a place, an asset, a picture that cannot be."""
    return any(operation.match(label) and any(one.search(sentence) for one in sentences) for operation, sentences in RULES) or not any(one.search(sentence) for one in ALONE)


def is_known(failure, case, response):
    """Whether a failure lies in the protocol."""
    label, status, kind = case.operation.label, response.status_code, type(failure).__name__
    if kind == 'RejectedPositiveData':
        problem = response.json()
        if status == 400:  # U+0000 is JSON, and in no text of kerrd: a schema would have to say so of each
            return 'NUL in a string' in problem.get('detail', '')
        if label == 'POST /v1/jobs' and problem.get('pointer', '').startswith('/playground'):
            return True  # it is a document of another operation, less some members, and free in this one's schema
        return status == 422 and is_together(label, problem.get('detail', ''))
    # OpenAPI 3.1 has the schema of the whole stream, a text; schemathesis holds it against each event.
    if failure.title == 'SSE event violates schema' and status == 200:
        return response.headers['content-type'][0].startswith('text/event-stream')
    # A session's, playground's, job's or asset's token is a capability: without it the answer is 403 with its problem type, and 401 is of the server's token file alone.
    if kind == 'MissingHeaderNotRejected' and status == 403:
        return response.json().get('type') == 'urn:kerrd:problem:forbidden'
    return False
